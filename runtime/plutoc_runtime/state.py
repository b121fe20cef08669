"""What the runtime remembers of a mission while it lives, beside what its user sees."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, TypeVar

from .status import Status, TripStatus

if TYPE_CHECKING:
    from .core import Core
    from .engine import Engine
    from .flight import Flight
    from .kernel import Task
    from .model import Drone, Item, Mission

T = TypeVar("T")

Place = tuple[str, str, int, int]
"""A delay: block, trip, round, attempt."""

MOST_CALLS = 100_000
"""Between two launches: a mission that calls its hooks so often is in a loop that it never leaves,
whether they answer at once or sleep in between."""


class Seldom(Generic[T]):
    """What most missions never have: it takes no room in their states until it is set."""

    def __init__(self, usual: T) -> None:
        self._usual, self._name = usual, ""

    def __set_name__(self, _: type[State], name: str) -> None:
        self._name = name

    def __get__(self, state: State, _: type[State] | None = None) -> T:
        if state.seldom is None:
            return self._usual
        value: T = state.seldom.get(self._name, self._usual)
        return value

    def __set__(self, state: State, value: T) -> None:
        if state.seldom is not None:
            state.seldom[self._name] = value
        elif value is not self._usual:
            state.seldom = {self._name: value}


class State:
    """One living mission. There may be very many: so it is small."""

    __slots__ = (
        "allocated",
        "at",
        "calls",
        "carrier",
        "core",
        "engine",
        "flight",
        "goes_on",
        "last_action_end",
        "mission",
        "seldom",
        "task",
    )

    interrupted = Seldom(False)
    """A flight of it was interrupted and does not count."""
    delay: Seldom[tuple[Place, float, float] | None] = Seldom(None)
    """Where it waits, when its delay is over, and its round begins."""
    waited: Seldom[set[Place] | None] = Seldom(None)
    """Every delay that is over."""
    first_start: Seldom[float | None] = Seldom(None)
    """When its first trip was let go."""
    carries: Seldom[Item | None] = Seldom(None)
    """The item aboard `carrier`, from `pick_item` to `release_item`."""
    doom: Seldom[str | None] = Seldom(None)
    """Why it must end whatever its graph says: a failure that no retry can mend."""

    def __init__(self, core: Core, mission: Mission[Any], engine: Engine) -> None:
        self.core, self.mission = core, mission
        self.engine = engine
        """Who sees it to its end."""
        self.seldom: dict[str, Any] | None = None
        """What is not as usual, by its name."""
        self.task: Task[Status] | None = None
        """The coroutine that takes it through its graph."""
        self.at: str | None = None
        """The last block it has met at which it can go on when it is interrupted."""
        self.goes_on = False
        """It was interrupted after a launch: until it is back there, it is given no drone."""
        self.allocated: Drone | None = None
        """The drone that waits to be launched."""
        self.flight: Flight | None = None
        """The flight that was launched last."""
        self.carrier: Drone | None = None
        """The drone that the mission keeps while it carries an item."""
        self.last_action_end: float | None = None
        """When its previous action in this round was done."""
        self.calls = 0
        """How often its hooks were called since its last launch."""

    def __call__(self, task: Task[Status]) -> None:
        """Hear that its coroutine is over."""
        self.engine.ended(self, task)

    def wait_for_a_person(self) -> None:
        """Take it out of its graph until a person has said how it goes on."""
        self.engine.waits(self)

    def end(self, reason: str) -> None:
        """Take it out of its graph, FAILED; only the first reason counts."""
        if self.doom is None:
            self.doom = reason
            self.engine.doomed(self)

    def goes_round(self) -> bool:
        """Count a call of a hook; say whether the mission goes round and round without a launch."""
        self.calls += 1
        return self.calls > MOST_CALLS

    @property
    def in_flight(self) -> Flight | None:
        """The flight that is not over yet."""
        flight = self.flight
        return flight if flight and flight.trip.status is TripStatus.EXECUTING else None
