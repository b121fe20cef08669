"""What a drone can do at the end of a trip: four built-in actions, and the app's own (thesis 4.1)."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping
from dataclasses import dataclass
from typing import Any

from .quantities import Type

Plain = bool | int | float | str

RECKONED = 5.0  # seconds that plans reckon with for an action that says nothing of it


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """A parameter of an action; without a default, every trip must give it. SI units."""

    name: str
    type: Type
    default: Plain | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Action:
    """An action, built-in or the app's own."""

    name: str
    parameters: tuple[Parameter, ...] = ()
    repeat: str = "once"  # may it be repeated after a crash of the system: `safe`, `once` or `ask`
    takes: float | str | None = None
    """How many seconds plans reckon with, or the parameter that says so; None: it is not declared."""
    hook: Callable[..., Any] | None = None
    """The app's own code; None: the drone's navigation knows how."""

    @property
    def seconds(self) -> float:
        """How many seconds plans reckon with where the parameters of a trip do not count."""
        return self.takes if isinstance(self.takes, (int, float)) else RECKONED

    def lasts(self, parameters: Mapping[str, Plain]) -> float:
        """Return how many seconds plans reckon with on a trip with these parameters."""
        takes = self.takes
        if takes is None:
            return RECKONED
        if not isinstance(takes, str):
            return takes
        default = next((one.default for one in self.parameters if one.name == takes), None)
        given = parameters.get(takes, default)
        return max(0.0, given) if isinstance(given, (int, float)) else RECKONED

    def act(self, state: Any, flight: Any) -> Coroutine[Any, Any, None]:
        """Call its hook; only an action of the app's own has one (flow/own_action.py)."""
        raise NotImplementedError(f"{self.name} is done by the drone's navigation")

    async def was_done(self, state: Any, flight: Any) -> bool | None:
        """Return whether its hook says that it was done; None: it cannot tell."""
        return None


PICK, RELEASE = "pick_item", "release_item"
MEASURE, PHOTO = "measure", "take_photo"

USUAL_QUANTITY = "temperature"
_QUANTITY = Parameter(name="quantity", type=Type.TEXT, default=USUAL_QUANTITY)

BUILT_IN: dict[str, Action] = {
    action.name: action
    for action in (
        Action(name=MEASURE, parameters=(_QUANTITY,), repeat="safe", takes=1.0),
        Action(name=PHOTO, repeat="safe", takes=1.0),
        Action(name=PICK, takes=2.0),
        Action(name=RELEASE, takes=2.0),
    )
}
"""The actions that every app has."""
