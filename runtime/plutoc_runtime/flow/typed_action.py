"""An action of the app's own that declares the type of what it gives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..domain.errors import HookFault
from ..domain.model import Photo
from ..domain.plain import as_a, plain_of
from ..domain.text import bounded, class_of, shown
from .own_action import OwnAction

if TYPE_CHECKING:
    from .flight import Flight
    from .mission import MissionState


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedAction(OwnAction):
    """An action whose hook returns values of one type; any other is a fault of the hook."""

    returns: type[object]

    async def _value(self, state: MissionState, flight: Flight) -> object:
        value = await OwnAction._value(self, state, flight)
        plain: object = value if type(value) is Photo is self.returns else None
        if self.returns is not Photo:
            plain = as_a(self.returns, value)
        if plain is None:
            reason = f"hook {self.name} must return {_SAID[self.returns]}, not {_given(value)}"
            raise HookFault(reason, reason)
        return plain


def _given(value: object) -> str:
    if value is None:
        return "None"
    is_odd = type(plain_of(value)) in (int, float) and as_a(float, value) is None
    why = "not finite, or too large" if is_odd else class_of(value)
    return f"{bounded(shown(value), 100)}, which is {why}"


_SAID: dict[type[object], str] = {
    bool: "True or False",
    int: "a whole number",
    float: "a number",
    str: "a text",
    Photo: "a Photo",
}
