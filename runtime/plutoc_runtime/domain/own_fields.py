"""Fields that an app declares itself, typed as an action's parameters are."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass

from .actions import Plain
from .fields import Field
from .plain import number_of, plain_of
from .quantities import Type, units_of


@dataclass(frozen=True, slots=True, kw_only=True)
class OwnField(Field):
    """A field of the app's own; without a default it must be filled in."""

    own: bool = True

    def __post_init__(self) -> None:
        if self.default is None and isinstance(self.type, Type):
            units = units_of(self.type)
            example = f'"1 {units[-1]}"' if units else _EXAMPLES[self.type]
            object.__setattr__(self, "hint", f": write {self.name} = {example}")

    @property
    def sample(self) -> Plain:
        """A value that it can have."""
        return _SAMPLES.get(self.type, 1.0) if self.default is None else self.default

    def wanted(self, value: object, evaluators: Container[str]) -> str:
        """Return what a value must be that a hook has set, if it is not that; None never is."""
        match self.type:
            case Type.TEXT:
                return "" if type(plain_of(value)) is str else "a text"
            case Type.BOOL:
                return "" if type(plain_of(value)) is bool else "True or False"
        number = number_of(value)
        if self.type is Type.INT:
            return "" if type(number) is int else "a whole number"
        return "" if number is not None else "a number"


_EXAMPLES = {Type.INT: "1", Type.FLOAT: "1.5", Type.BOOL: "true", Type.TEXT: '"text"'}
_SAMPLES: dict[object, Plain] = {Type.INT: 1, Type.BOOL: True, Type.TEXT: "text", Type.PERCENT: 0.5}
