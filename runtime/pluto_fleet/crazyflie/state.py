"""The state of a Crazyflie: one block of its log as one value, and the confidence of its position.

With beacons the variance of its estimate is small, and grows when they are lost. With only a flow deck, which
measures relative movement, it is never small: then it counts that the variance is steady.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from math import dist, inf, isfinite, radians
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..shared.domain.model import Point


# Together 23 of the 26 bytes of a block, so that position and status belong to one moment.
X, Y, Z, YAW = "stateEstimate.x", "stateEstimate.y", "stateEstimate.z", "stateEstimate.yaw"
VOLTS, POWER, INFO = "pm.vbat", "pm.state", "supervisor.info"
STATE = (X, Y, Z, YAW, VOLTS, POWER, INFO)
VARIANCES = ("kalman.varPX", "kalman.varPY", "kalman.varPZ")

ROUND = (1 << 24) / 1000.0
"""Seconds after which the clock of the log wraps around."""
LOW_POWER = 3
"""The value of `pm.state` for a low battery; above it, it switches off."""

_CAN_ARM, _ARMED, _AUTO, _CAN_FLY, _FLIES, _TUMBLED, _LOCKED, _CRASHED, _STEERED, _FINISHED = (
    1 << place for place in range(10)
)
_DECK = 1 << 11


@dataclass(frozen=True, slots=True, kw_only=True)
class State:
    """Its state at one moment."""

    time: float
    """When it was received, by the event loop's clock."""
    sent: float
    """When it was sent, by the drone's own clock."""
    position: Point
    yaw: float
    """Radians."""
    volts: float
    power: int
    bits: int
    """The bits of its supervisor."""

    @property
    def armed(self) -> bool:
        """Whether it is armed."""
        return bool(self.bits & _ARMED)

    @property
    def can_arm(self) -> bool:
        """Whether it can be armed, or is armed."""
        return bool(self.bits & (_CAN_ARM | _ARMED))

    @property
    def arms_itself(self) -> bool:
        """Whether its build arms automatically."""
        return bool(self.bits & _AUTO)

    @property
    def can_fly(self) -> bool:
        """Whether it can take off."""
        return bool(self.bits & _CAN_FLY)

    @property
    def crashed(self) -> bool:
        """Whether it has fallen, or lies on its back."""
        return bool(self.bits & (_TUMBLED | _CRASHED))

    @property
    def lies(self) -> bool:
        """Whether it is not upright."""
        return bool(self.bits & _TUMBLED)

    @property
    def deck_failed(self) -> bool:
        """Whether one of its decks reports a fault: then it does not arm, and locks in the air."""
        return bool(self.bits & _DECK)

    @property
    def locked(self) -> bool:
        """Whether it must be restarted."""
        return bool(self.bits & _LOCKED)

    @property
    def steered(self) -> bool:
        """Whether its high-level commander moves it: its motors turn."""
        return self.has_trajectory and self.armed

    @property
    def has_trajectory(self) -> bool:
        """Whether its high-level commander has a trajectory, whether or not its motors may turn."""
        return bool(self.bits & _STEERED)

    @property
    def finished(self) -> bool:
        """Whether its trajectory has ended."""
        return bool(self.bits & _FINISHED)

    @property
    def flies(self) -> bool:
        """Whether it is in the air, or was two seconds ago."""
        return bool(self.bits & _FLIES) or self.steered

    def since(self, before: State) -> float:
        """Return the seconds since another state, by the drone's clock, which wraps around every few hours."""
        return (self.sent - before.sent) % ROUND

    def distance(self, place: Point) -> float:
        """Return the distance of a place, in metres."""
        return dist(self.position, place)

    @property
    def said(self) -> str:
        """The bits of its supervisor in words."""
        facts = (
            (self.locked, "locked"),
            (self.crashed, "tumbled or crashed"),
            (self.deck_failed, "a deck reports a fault"),
            (not self.armed, "not armed"),
            (not self.can_fly, "cannot fly"),
            (self.flies, "flying"),
        )
        return ", ".join(word for true, word in facts if true) or "ready"


def state_of(values: Mapping[str, float], time: float, sent: float) -> State:
    """Return the state in a log block; variables that this firmware lacks are 0."""

    def get(name: str) -> float:
        return values.get(name, 0.0)

    return State(
        time=time,
        sent=sent,
        position=(get(X), get(Y), get(Z)),
        yaw=radians(get(YAW)),
        volts=get(VOLTS),
        power=int(get(POWER)),
        bits=int(get(INFO)),
    )


SETTLED_FOR = 1.0
"""Seconds of confidence that are required: just after a start the estimate still settles."""
_STEADY = 0.001
"""Square metres by which the variance may change meanwhile with only a flow deck."""
_STALE = 1.5

Variances = tuple[float, ...]


class PositionConfidence:
    """The history of its variances."""

    def __init__(self) -> None:
        self._told: deque[tuple[float, Variances]] = deque()

    @property
    def variance(self) -> float | None:
        """The latest variance, the largest of the three axes, in square metres."""
        return max(self._told[-1][1]) if self._told else None

    def hear(self, variances: Variances, time: float) -> None:
        """Add new variances."""
        if self._told and time - self._told[-1][0] > _STALE:
            self._told.clear()
        self._told.append((time, tuple(v if isfinite(v) else inf for v in variances)))
        while len(self._told) > 1 and time - self._told[1][0] >= SETTLED_FOR:
            self._told.popleft()

    def forget(self) -> None:
        """Reset: its estimate restarts."""
        self._told.clear()

    def sure(self, time: float, within: float) -> bool:
        """Return whether its deviation was below this many metres for long enough."""
        return self._tells(time) and all(max(told) <= within**2 for _, told in self._told)

    def steady(self, time: float) -> bool:
        """Return whether its variance was steady for long enough, whatever its size."""
        if not self._tells(time):
            return False
        axes = zip(*(variances for _, variances in self._told), strict=True)
        return all(max(axis) < inf and max(axis) - min(axis) <= _STEADY for axis in axes)

    def lost(self, beyond: float) -> bool:
        """Return whether its deviation was above this many metres for long enough."""
        return self._is_long() and all(max(told) > beyond**2 for _, told in self._told)

    def doubts(self, beyond: float) -> bool:
        """Return whether its present deviation is above this many metres."""
        variance = self.variance
        return variance is not None and variance > beyond**2

    def _tells(self, time: float) -> bool:
        return self._is_long() and time - self._told[-1][0] <= _STALE

    def _is_long(self) -> bool:
        return bool(self._told) and self._told[-1][0] - self._told[0][0] >= SETTLED_FOR
