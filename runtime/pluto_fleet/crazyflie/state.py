"""The state of a Crazyflie: one block of its log as one value, and the confidence of its position.

With beacons the variance of its estimate is small, and grows when they are lost. With only a flow deck, which
measures relative movement, it is never small: then it counts that the variance is steady.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import dist, inf, isfinite, radians

from ..drones.battery_gauge import LOW
from ..drones.protocol import BATTERY_LOW, CRASHED, LOCKED, POSITION_LOST, DroneEvent
from ..shared.domain.model import Point
from . import messages

# Together 23 of the 26 bytes of a block, so that position and status belong to one moment.
X, Y, Z, YAW = "stateEstimate.x", "stateEstimate.y", "stateEstimate.z", "stateEstimate.yaw"
VOLTS, POWER, INFO = "pm.vbat", "pm.state", "supervisor.info"
STATE = (X, Y, Z, YAW, VOLTS, POWER, INFO)
VARIANCES = ("kalman.varPX", "kalman.varPY", "kalman.varPZ")

ROUND = (1 << 24) / 1000.0
"""Seconds after which the clock of the log wraps around."""
LOW_POWER = 3
"""The value of `pm.state` for a low battery; above it, it switches off."""


class _Bit:
    """A bit of the supervisor's state."""

    def __init__(self, place: int) -> None:
        self._mask = 1 << place

    def __get__(self, state: State, _: object = None) -> bool:
        return bool(state.bits & self._mask)


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

    armable = _Bit(0)
    """Whether it is not armed, and can be."""
    armed = _Bit(1)
    arms_itself = _Bit(2)
    """Whether its build arms automatically."""
    can_fly = _Bit(3)
    lies = _Bit(5)
    """Whether it is not upright."""
    locked = _Bit(6)
    """Whether it must be restarted."""
    has_trajectory = _Bit(8)
    """Whether its high-level commander has a trajectory, whether or not its motors may turn."""
    finished = _Bit(9)
    """Whether that has ended."""
    deck_failed = _Bit(11)
    """Whether one of its decks reports a fault: then it does not arm, and locks in the air."""
    _flying = _Bit(4)
    _fell = _Bit(7)

    @property
    def can_arm(self) -> bool:
        """Whether it can be armed, or is armed."""
        return self.armable or self.armed

    @property
    def crashed(self) -> bool:
        """Whether it has fallen, or lies on its back."""
        return self.lies or self._fell

    @property
    def steered(self) -> bool:
        """Whether its high-level commander moves it: its motors turn."""
        return self.has_trajectory and self.armed

    @property
    def flies(self) -> bool:
        """Whether it is in the air, or was two seconds ago."""
        return self._flying or self.steered

    def since(self, before: State) -> float:
        """Return the seconds since another state, by the drone's clock, which wraps around every few hours."""
        return (self.sent - before.sent) % ROUND

    def distance(self, place: Point) -> float:
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


LOW_FOR = 3.0
"""Seconds that it must be low, as a burst of the motors lowers the voltage, too."""
_WELL = 3.5
"""The voltage of a cell at which a battery counts as replaced or charged."""


class AlarmDetector:
    """Detects alarms: each is reported once, when it begins."""

    def __init__(self, cells: int = 1) -> None:
        self._cells = cells
        self._crashed = self._locked = self._low = self._adrift = False
        self._low_since: float | None = None

    def hear(self, state: State) -> Iterator[DroneEvent]:
        """Yield the events since the last state."""
        if state.crashed and not self._crashed:
            yield DroneEvent(kind=CRASHED, reason=messages.LIES)
        if state.locked and not self._locked:
            why = messages.IS_LOCKED
            if state.deck_failed:
                why = f"one of its decks reports a fault, and {why}"
            yield DroneEvent(kind=LOCKED, reason=why)
        self._crashed = state.crashed
        self._locked = state.locked
        if self._battery_low(state):
            yield DroneEvent(kind=BATTERY_LOW, reason=f"its battery is down to {state.volts:.2f} V")

    def hear_of_its_place(self, adrift: bool, variance: float) -> Iterator[DroneEvent]:
        """Yield the event that it has lost its position in the air."""
        if adrift and not self._adrift:
            yield DroneEvent(kind=POSITION_LOST, reason=messages.adrift(variance))
        self._adrift = adrift

    def _battery_low(self, state: State) -> bool:
        """Return whether it has just become so low that it must land."""
        volts = state.volts / self._cells
        if state.power != LOW_POWER and not 0.0 < volts < LOW:
            self._low_since = None
            self._low = self._low and volts < _WELL
            return False
        if self._low_since is None:
            self._low_since = state.time
        if self._low or state.time - self._low_since < LOW_FOR:
            return False
        self._low = True
        return True
