"""What a drone can do at the end of a trip: four built-in actions, and the app's own (thesis 4.1)."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from typing import Any

from .quantities import Type

Plain = bool | int | float | str


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
    seconds: float = 5.0  # how long it is expected to take, for planning; it may take longer
    hook: Callable[..., Any] | None = None
    """The app's own code; None: the drone's navigation knows how."""

    def act(self, state: Any, flight: Any) -> Coroutine[Any, Any, None]:
        """Call its hook; only an action of the app's own has one (flow/own_action.py)."""
        raise NotImplementedError(f"{self.name} is done by the drone's navigation")

    async def was_done(self, state: Any, flight: Any) -> bool | None:
        """Return whether its hook says that it was done; None: it cannot tell."""
        return None


PICK, RELEASE = "pick_item", "release_item"
MEASURE, PHOTO = "measure", "take_photo"

_QUANTITY = Parameter(name="quantity", type=Type.TEXT, default="temperature")

BUILT_IN: dict[str, Action] = {
    action.name: action
    for action in (
        Action(name=MEASURE, parameters=(_QUANTITY,), repeat="safe", seconds=1.0),
        Action(name=PHOTO, repeat="safe", seconds=1.0),
        Action(name=PICK, seconds=2.0),
        Action(name=RELEASE, seconds=2.0),
    )
}
"""The actions that every app has."""
