"""Missions, trips and drones (thesis 4.1), and the results of actions (thesis 6.1.3).

A generated package adds to `Mission` and `Trip` the fields that its graph needs, and no others.
Positions are (x, y, z) in metres in the map's frame, times are seconds since the app started.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from math import dist
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, Protocol, TypeVar

from .keeper import Kept, Trips, first_of, keeper_of, list_of_trips, put
from .motion import STRAIGHT, Motion, charging
from .status import UNEXECUTED, DroneStatus, Status, TripStatus

if TYPE_CHECKING:
    from .actions import Plain

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Category:
    """A shape category: what drones of one kind can carry and do (thesis 4.1). SI units."""

    name: str
    payload: float = 0.010
    speed: float = 0.5
    flight_time: float = 420.0
    charge_time: float = 1200.0
    reserve: float = 0.2
    """The share of the battery that a flight must leave."""
    actions: frozenset[str] | None = None
    """None: every action."""
    motion: Motion = STRAIGHT
    """How its drones fly, by the fleet's file."""

    @property
    def endurance(self) -> float:
        """How many seconds in the air take a full battery."""
        return self.flight_time / (self.motion.drain * self.motion.effort)

    def can(self, action: str) -> bool:
        """Return whether drones of this category can do the action."""
        return self.actions is None or action in self.actions


@dataclass(frozen=True, slots=True, kw_only=True)
class Item:
    """What `pick_item` picks and `release_item` puts down; kilograms."""

    name: str
    mass: float


class Sighting(NamedTuple):
    """Something that moves, as a camera sees it."""

    track: str
    kind: str
    at: Point


@dataclass(frozen=True, slots=True, kw_only=True)
class Photo:
    """A photo straight down, the result of `take_photo`."""

    position: Point
    """Where the camera really was."""
    width: float
    """Metres of ground that it covers, along x and along y."""
    height: float
    sees: tuple[str, ...] = ()
    """What can be made out on it, such as `bloom` or `pest`."""
    tracks: tuple[Sighting, ...] = ()
    """What moves on it."""
    sharpness: float = 1.0
    """From 0, useless, to 1."""
    file: str | None = None
    """Where the picture itself is kept; a simulated camera takes none."""


class AfterTrip(Enum):
    """Where a drone goes after a trip."""

    HOME = "home"
    STAY = "stay"
    NEXT = "next"
    ONWARD = "onward"  # as `NEXT`, and from the air where a trip waits


class Telemetry(Protocol):
    """The current state of a drone, as its navigation knows it."""

    @property
    def location(self) -> Point:
        """Where it is."""

    @property
    def battery_level(self) -> float:
        """The charge of the battery, from 0 to 1."""

    @property
    def landed(self) -> bool:
        """Whether it stands on the ground or in its dock."""


@dataclass(slots=True, kw_only=True, eq=False)
class Drone(Kept):
    """A drone of the fleet. The system chooses one: no user addresses it."""

    _called = "drone"
    id: str
    category: Category
    home: Point
    telemetry: Telemetry
    status: DroneStatus = DroneStatus.FREE
    trips: int = 0
    """How many trips it has flown."""
    index: int = 0
    """Its place in the fleet file."""

    @property
    def location(self) -> Point:
        """Where it is now."""
        return self.telemetry.location

    @property
    def battery_level(self) -> float:
        """What is left in its battery now, from 0 to 1."""
        return self.telemetry.battery_level

    def charging(self, level: float) -> float:
        """Return how many seconds it must charge to reach a level."""
        full, taper = self.category.charge_time, self.category.motion.taper
        return charging(self.battery_level, level, full, taper)

    def distance(self, point: Point) -> float:
        """Return how far away a point is, in metres."""
        return dist(self.location, point)


@dataclass(slots=True, kw_only=True, eq=False)
class Trip(Kept):
    """A drone's flight to a target that ends with an action."""

    _called = "trip"
    _edited = frozenset({"action", "item", "parameters", "source", "target"})
    name: str
    action: str
    target: Point
    source: Point | None = None
    """Where the flight begins; None: where the drone is."""
    parameters: Mapping[str, Plain] = field(default_factory=dict)
    """The action's parameters, in SI units."""
    item: Item | None = None
    status: TripStatus = field(default=TripStatus.WAITING, init=False)
    drone: Drone | None = field(default=None, init=False)
    """Who flies it, from allocation on."""
    start_time: float | None = field(default=None, init=False)
    """When its drone left for it, the last time."""
    end_time: float | None = field(default=None, init=False)
    attempt: int = field(default=1, init=False)
    """How often it has been tried in this round, this time included."""
    index: int = 0
    """Its place in the missions file."""
    added: bool = field(default=False, init=False)
    """An evaluator added it: it is not repeated."""
    reason: str = field(default="", init=False)
    """Why it failed, the last time."""
    number: int = field(default=0, init=False, repr=False)
    """Of its row among all trips that its mission has ever had; 0: it has none."""
    rank: int = field(default=0, init=False, repr=False)
    """Of two trips to do, or two done ones, the lower comes first."""

    @property
    def elapsed(self) -> float:
        """Seconds that it has been flying, or flew; 0 before it starts."""
        if self.start_time is None:
            return 0.0
        if self.end_time is not None:
            return self.end_time - self.start_time
        keeper = keeper_of(self)
        return 0.0 if keeper is None else keeper.time() - self.start_time

    def expired(self, limit: float) -> bool:
        """Return whether it has been flying, or flew, for this many seconds or more."""
        return self.start_time is not None and self.elapsed >= limit

    @property
    def ended(self) -> bool:
        """Whether it is over, well or not."""
        return self.status in (TripStatus.COMPLETED, TripStatus.FAILED)

    def _closed(self) -> str:
        """Return why even a modifier may not write it now; empty: it may."""
        match self.status:
            case TripStatus.EXECUTING:
                return f"trip {self.name} is in flight, and can be changed when it has ended"
            case TripStatus.COMPLETED:
                return f"trip {self.name} is completed, and an evaluator can have it flown again"
        return ""

    def reset(self) -> None:
        """Put it back: it is WAITING again and counts as one more attempt."""
        if why := self._closed():
            raise ValueError(f"it cannot be reset: {why}")
        if (keeper := keeper_of(self)) is not None:
            keeper.must_edit("trip.reset() cannot be called here")
            keeper.note(self, "status", "attempt", "drone", "start_time", "end_time")
        put_back(self)


def put_back(trip: Trip) -> None:
    """Make a trip WAITING again; if it was not, its next flight is one more attempt."""
    if trip.status is not TripStatus.WAITING:
        put(trip, status=TripStatus.WAITING, attempt=trip.attempt + 1)
        put(trip, drone=None, start_time=None, end_time=None)


T = TypeVar("T", bound=Trip)

NO_RESULT = -1  # the number of a result that there is not


@dataclass(slots=True, kw_only=True, eq=False)
class Mission(Kept, Generic[T]):
    """A list of trips, flown one after the other. Missions run side by side."""

    _called = "mission"
    name: str
    trips: list[T]
    """Still to do, in order; the first is the one that flies now, or flies next. Modifiers may change it."""
    completed_trips: tuple[T, ...] = field(default=(), init=False)
    status: Status = field(default=UNEXECUTED, init=False)
    reason: str = field(default="", init=False)
    """Why it failed."""
    round: int = field(default=0, init=False)
    """How often it has begun again."""
    attempts: int = field(default=0, init=False)
    """How many flights it has had, good and bad; one that was interrupted does not count."""
    index: int = 0
    """Its place in the missions file."""
    promises: Mapping[str, Any] = field(default_factory=dict, repr=False)
    """What its plan promises; see `flow/promises.py`."""
    deadline: float | None = field(default=None, init=False)
    """When it is to have ended, in seconds since the app started."""
    late: bool = field(default=False, init=False)
    """Whether it had not ended by then."""
    last_result: int = field(default=NO_RESULT, init=False, repr=False)
    """The number of its newest result that its evaluator has not seen."""

    if not TYPE_CHECKING:

        def __setattr__(self, name: str, value: object) -> None:
            if name != "trips":
                Kept.__setattr__(self, name, value)
            elif (trips := getattr(self, "trips", None)) is None:
                put(self, trips=Trips(value))
            else:
                trips[:] = list_of_trips(value)

    @property
    def current(self) -> T:
        """The trip that flies now, or flies next; when none is left, the one flown last."""
        current: T = first_of(self.trips, self.completed_trips)
        return current


M = TypeVar("M", bound=Mission[Any])


class Result(NamedTuple, Generic[M, T]):
    """The result of one action, identified by (mission, trip, round, attempt)."""

    mission: M
    trip: T
    round: int
    attempt: int
    value: object
    time: float = 0.0
    """When the action was done, in seconds since the app started."""
    place: Point | None = None
    """Where its drone was then."""


class Results(NamedTuple, Generic[M, T]):
    """The results that an evaluator gets."""

    new: Sequence[Result[M, T]]
    """The mission's results since its last evaluation."""
    all: Sequence[Result[M, T]]
    """The results of all missions."""


class ResultStore:
    """Stores the results; those of one mission are a linked list, headed by `mission.last_result`."""

    def __init__(self) -> None:
        self.results: list[Result[Any, Any]] = []
        self.before: list[int] = []
        """For each result, the number of the previous one of its mission."""

    def add(self, result: Result[Any, Any]) -> int:
        """Store the result of an action, and return its number."""
        self.results.append(result)
        self.before.append(result.mission.last_result)
        return len(self.results) - 1

    def first_new(self, mission: Mission[Any]) -> int:
        """Return the number of the first result that a mission's evaluator has not seen."""
        first = len(self.results)
        number = mission.last_result
        while number != NO_RESULT:
            first = number
            number = self.before[number]
        return first
