"""An action of the app's own that declares the type of what it gives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from ..domain.errors import HookFault
from ..domain.fields import number_of
from ..domain.model import Photo
from ..domain.text import bounded, class_of, shown
from .own_action import OwnAction

if TYPE_CHECKING:
    from ..trips.flight import Flight
    from .mission import MissionState


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedAction(OwnAction):
    """An action whose hook returns values of one type; any other is a fault of the hook."""

    returns: type[object]

    async def _value(self, state: MissionState, flight: Flight) -> object:
        value = await OwnAction._value(self, state, flight)
        plain = _plain(self.returns, value)
        if plain is None:
            given = "None" if value is None else f"{_shown(value)}, which is {class_of(value)}"
            reason = f"hook {self.name} must return {_SAID[self.returns]}, not {given}"
            raise HookFault(reason, reason)
        return plain


def _plain(kind: type[object], value: object) -> object | None:
    """Return a hook's value as a plain one of a type; None: it is not of that type."""
    given = type(value)
    if kind is str and issubclass(given, str):
        return str.__str__(cast("str", value))
    if kind is float and issubclass(given, float):
        return float.__pos__(cast("float", value))  # NaN and infinity, too: a sensor may give them
    if kind is float and given is int and abs(cast("int", value)) < _LARGEST:
        return float(cast("int", value))
    if kind in (int, float) and given not in (int, bool):
        number = number_of(value)  # such as numpy's
        fits = type(number) is int or (kind is float and number is not None)
        return cast("type[float]", kind)(cast("float", number)) if fits else None
    return value if given is kind else None


_LARGEST = 1 << 1000  # a float holds it


def _shown(value: object) -> str:
    return bounded(shown(value), 100)


_SAID: dict[type[object], str] = {
    bool: "True or False",
    int: "a whole number",
    float: "a number",
    str: "a text",
    Photo: "a Photo",
}
