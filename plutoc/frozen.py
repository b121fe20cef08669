"""Values that nobody changes, and records that are filled: dataclasses made in a fifth of the time.

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
    made = _prepared(cls)
    names = tuple(field.name for field in fields(made))
    values: Any = attrgetter(*names) if names else lambda self: ()

    def equal(self: Any, other: Any) -> bool:
        return values(self) == values(other) if other.__class__ is made else NotImplemented

    made.__eq__ = equal
    made.__hash__ = lambda self: hash(values(self))
    made.__repr__ = _repr
    return cast("type[T]", made)


@dataclass_transform(frozen_default=True, kw_only_default=True, eq_default=False)
def frozen_one(cls: type[T]) -> type[T]:
    """Make such a dataclass of which each one is equal to itself only, whatever it holds."""
    return cast("type[T]", _prepared(cls))


@dataclass_transform(kw_only_default=True, eq_default=False)
def filled(cls: type[T]) -> type[T]:
    """Make such a dataclass whose fields do change, and of which each is equal to itself only."""
    return cast("type[T]", _slotted(cls))


def _prepared(cls: Any) -> Any:
    made = _slotted(cls)
    made.__reduce__ = _reduce
    made.__setattr__ = _refuse
    made.__delattr__ = _refuse
    return made


def _slotted(cls: Any) -> Any:
    cls.__doc__ = cls.__doc__ or cls.__name__  # or the library would spell out its signature
    made: Any = dataclass(init=False, repr=False, eq=False, slots=True, kw_only=True)(cls)
    made.__init__ = _init(made)
    return made


def _init(made: Any) -> Any:
    found = fields(made)
    puts = tuple((f.name, getattr(made, f.name).__set__) for f in found)
    defaults = {f.name: f.default for f in found if f.default is not MISSING}
    makers = [(f.name, f.default_factory) for f in found if f.default_factory is not MISSING]
    name_of_class = made.__name__

    def init(self: Any, **given: Any) -> None:
        if len(given) != len(puts):
            given = {**defaults, **{name: make() for name, make in makers}, **given}
        try:
            for name, put in puts:
                put(self, given[name])
        except KeyError as missing:
            raise TypeError(f"{name_of_class} needs {missing}") from None
        if len(given) != len(puts):
            raise TypeError(f"{name_of_class} has no {given.keys() - {name for name, _ in puts}}")

    return init


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
