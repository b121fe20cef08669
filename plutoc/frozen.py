"""Values that nobody changes: dataclasses that are made in a fifth of the time.

`dataclass(frozen=True, slots=True)` writes and compiles six methods for each class, whenever it is
imported. With a hundred classes that is a third of the time that `plutoc check` takes for a small
app. Here nothing is compiled: the methods are functions over the slots.
"""

from __future__ import annotations

from dataclasses import MISSING, FrozenInstanceError, dataclass, fields
from operator import attrgetter
from typing import Any, TypeVar, cast, dataclass_transform

T = TypeVar("T")


@dataclass_transform(frozen_default=True, kw_only_default=True)
def frozen(cls: type[T]) -> type[T]:
    """Make a dataclass with slots, whose fields are given by name and never change."""
    cls.__doc__ = cls.__doc__ or cls.__name__  # or the library would spell out its signature
    made: Any = dataclass(init=False, repr=False, eq=False, slots=True, kw_only=True)(cls)
    names = tuple(field.name for field in fields(made))
    defaults = {f.name: f.default for f in fields(made) if f.default is not MISSING}
    slots = tuple((name, getattr(made, name).__set__) for name in names)
    values: Any = attrgetter(*names) if names else lambda self: ()

    def init(self: Any, **given: Any) -> None:
        if len(given) != len(slots):
            given = {**defaults, **given}
        try:
            for name, put in slots:
                put(self, given[name])
        except KeyError as missing:
            raise TypeError(f"{cls.__name__} needs {missing}") from None
        if len(given) != len(slots):
            raise TypeError(f"{cls.__name__} has no {given.keys() - set(names)}")

    def equal(self: Any, other: Any) -> bool:
        return values(self) == values(other) if other.__class__ is made else NotImplemented

    made.__init__ = init
    made.__eq__ = equal
    made.__hash__ = lambda self: hash(values(self))
    made.__repr__ = _repr
    made.__reduce__ = _reduce
    made.__setattr__ = _refuse
    made.__delattr__ = _refuse
    return cast("type[T]", made)


def _repr(self: Any) -> str:
    said = ", ".join(f"{field.name}={getattr(self, field.name)!r}" for field in fields(self))
    return f"{type(self).__qualname__}({said})"


def _reduce(self: Any) -> tuple[Any, ...]:
    """Tell how to make a copy: not by setting its fields."""
    return _made, (type(self), {field.name: getattr(self, field.name) for field in fields(self)})


def _made(cls: Any, values: dict[str, Any]) -> Any:
    return cls(**values)


def _refuse(self: Any, name: str, value: object = None) -> None:
    raise FrozenInstanceError(f"{type(self).__name__} never changes: its {name} stays as it is")
