"""What a Crazyflie tells of itself ten times a second: one block of its log, as one value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import dist, radians
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

# Together 23 of the 26 bytes that a block may have: where it is and how it is belong to one moment.
X, Y, Z, YAW = "stateEstimate.x", "stateEstimate.y", "stateEstimate.z", "stateEstimate.yaw"
VOLTS, POWER, INFO = "pm.vbat", "pm.state", "supervisor.info"
STATE = (X, Y, Z, YAW, VOLTS, POWER, INFO)
CERTAINTY = ("kalman.varPX", "kalman.varPY", "kalman.varPZ")

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
        return self.has_course and self.armed

    @property
    def has_course(self) -> bool:
        """Whether its high-level commander follows one, be its motors permitted to turn or not."""
        return bool(self.bits & _STEERED)

    @property
    def finished(self) -> bool:
        """Whether it is at the end of the course that it was given."""
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
