"""What a Crazyflie tells of itself: one block of its log as one value, and how sure it is of its position.

One that sees beacons becomes sure: the variance of its estimate is small, and grows when they are not
seen any more. One that only sees the ground pass by never is, for its start is nowhere: then it counts
that the variance stays what it is.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from math import dist, inf, isfinite, radians
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point


# Together 23 of the 26 bytes that a block may have: where it is and how it is belong to one moment.
X, Y, Z, YAW = "stateEstimate.x", "stateEstimate.y", "stateEstimate.z", "stateEstimate.yaw"
VOLTS, POWER, INFO = "pm.vbat", "pm.state", "supervisor.info"
STATE = (X, Y, Z, YAW, VOLTS, POWER, INFO)
VARIANCES = ("kalman.varPX", "kalman.varPY", "kalman.varPZ")

ROUND = (1 << 24) / 1000.0
"""Seconds after which the clock of the log begins anew."""
LOW_POWER = 3
"""What `pm.state` says of a battery that is low; above it, it switches off."""

_CAN_ARM, _ARMED, _AUTO, _CAN_FLY, _FLIES, _TUMBLED, _LOCKED, _CRASHED, _STEERED, _FINISHED = (
    1 << place for place in range(10)
)
_DECK = 1 << 11


@dataclass(frozen=True, slots=True, kw_only=True)
class State:
    """How it was at one moment."""

    time: float
    """By `time.monotonic()`, when it arrived here."""
    sent: float
    """By the drone's own clock: two that arrive at one moment were not sent at one."""
    position: Point
    yaw: float
    """Radians."""
    volts: float
    power: int
    bits: int
    """What its supervisor says."""

    @property
    def armed(self) -> bool:
        """Whether its motors may be started."""
        return bool(self.bits & _ARMED)

    @property
    def can_arm(self) -> bool:
        """Whether it would arm, or is armed."""
        return bool(self.bits & (_CAN_ARM | _ARMED))

    @property
    def arms_itself(self) -> bool:
        """Whether its build arms it whenever it can be."""
        return bool(self.bits & _AUTO)

    @property
    def can_fly(self) -> bool:
        """Whether it would take off."""
        return bool(self.bits & _CAN_FLY)

    @property
    def crashed(self) -> bool:
        """Whether it has fallen, or lies on its back."""
        return bool(self.bits & (_TUMBLED | _CRASHED))

    @property
    def lies(self) -> bool:
        """Whether it does not stand upright."""
        return bool(self.bits & _TUMBLED)

    @property
    def deck_failed(self) -> bool:
        """Whether one of its decks reports a fault: it does not arm then, and locks in the air."""
        return bool(self.bits & _DECK)

    @property
    def locked(self) -> bool:
        """Whether it must be switched off and on."""
        return bool(self.bits & _LOCKED)

    @property
    def steered(self) -> bool:
        """Whether its high-level commander moves it: its motors turn."""
        return self.has_trajectory and self.armed

    @property
    def has_trajectory(self) -> bool:
        """Whether its high-level commander follows one, be its motors permitted to turn or not."""
        return bool(self.bits & _STEERED)

    @property
    def finished(self) -> bool:
        """Whether it is at the end of the trajectory that it was given."""
        return bool(self.bits & _FINISHED)

    @property
    def flies(self) -> bool:
        """Whether it is in the air, or was two seconds ago."""
        return bool(self.bits & _FLIES) or self.steered

    def since(self, before: State) -> float:
        """Return the seconds that have passed for the drone; its clock begins anew every few hours."""
        return (self.sent - before.sent) % ROUND

    def distance(self, place: Point) -> float:
        """Return how far away a place is, in metres."""
        return dist(self.position, place)

    @property
    def said(self) -> str:
        """What its supervisor says, in words."""
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
    """Return what a block of the log says; what this firmware has not is 0."""

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
"""Seconds that it must be so: just after a start the estimate still settles."""
_STEADY = 0.001
"""Square metres by which the variance may change meanwhile of one that only sees the ground."""
_STALE = 1.5

Variances = tuple[float, ...]


class PositionConfidence:
    """What its variances have been."""

    def __init__(self) -> None:
        self._told: deque[tuple[float, Variances]] = deque()

    @property
    def variance(self) -> float | None:
        """The largest of the three axes', in square metres, as it was last."""
        return max(self._told[-1][1]) if self._told else None

    def hear(self, variances: Variances, time: float) -> None:
        """It told them."""
        if self._told and time - self._told[-1][0] > _STALE:
            self._told.clear()
        self._told.append((time, tuple(v if isfinite(v) else inf for v in variances)))
        while len(self._told) > 1 and time - self._told[1][0] >= SETTLED_FOR:
            self._told.popleft()

    def forget(self) -> None:
        """Its estimate begins anew."""
        self._told.clear()

    def sure(self, time: float, within: float) -> bool:
        """Say whether it has known its place for long enough, to so many metres on each axis."""
        return self._tells(time) and all(max(told) <= within**2 for _, told in self._told)

    def steady(self, time: float) -> bool:
        """Say whether it has been as sure as it is for long enough, however sure that is."""
        if not self._tells(time):
            return False
        axes = zip(*(variances for _, variances in self._told), strict=True)
        return all(max(axis) < inf and max(axis) - min(axis) <= _STEADY for axis in axes)

    def lost(self, beyond: float) -> bool:
        """Say whether it has not known its place for long enough, not even to so many metres."""
        return self._is_long() and all(max(told) > beyond**2 for _, told in self._told)

    def doubts(self, beyond: float) -> bool:
        """Say whether it does not know its place to so many metres at the moment."""
        variance = self.variance
        return variance is not None and variance > beyond**2

    def _tells(self, time: float) -> bool:
        return self._is_long() and time - self._told[-1][0] <= _STALE

    def _is_long(self) -> bool:
        return bool(self._told) and self._told[-1][0] - self._told[0][0] >= SETTLED_FOR
