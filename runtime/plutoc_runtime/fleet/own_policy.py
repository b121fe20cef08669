"""A policy of the app's own: a hook that is asked trip by trip, or at once for all that wait with one priority."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from inspect import signature
from itertools import islice
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeAlias, TypeVar

from ..domain.errors import HookFault
from ..domain.model import Drone, Mission, Trip
from ..domain.plain import number_of
from ..domain.text import class_of, quoted
from ..hooks.calls import ask_policy, hook_name
from ..time.kernel import FLEET, EventKind
from .batch import Batch

if TYPE_CHECKING:
    from .policies import Able, Choice, OneByOne, Policy
    from .queue import Queue, Request

M = TypeVar("M", bound=Mission[Any])
T = TypeVar("T", bound=Trip)


class Waiting(NamedTuple, Generic[M, T]):
    """A trip that waits for a drone."""

    mission: M
    trip: T
    drones: Sequence[Drone]
    """The free drones that can fly it now."""
    since: float = 0.0
    """When it began to wait, in seconds since the app started."""
    priority: int = 0
    deadline: float | None = None
    """When its mission is to have ended, in seconds since the app started."""

    def __hash__(self) -> int:
        """Hash by identity: its drones may be a list."""
        return object.__hash__(self)


class Again(NamedTuple):
    """An assignment after which a policy is asked again, even if nothing changes until then."""

    after: float
    """In how many seconds; 0.1 at least."""
    pairs: Mapping[Any, Drone] | Iterable[tuple[Any, Drone]] = ()
    """Which trips get which drones now."""


Assignment: TypeAlias = Mapping[Any, Drone] | Iterable[tuple[Any, Drone]] | Again
"""Which waiting trips get which drones; none: all wait."""

SOONEST = 0.1
MOST_IN_VAIN = 100_000
"""How often a policy may ask to be asked again before it gives a drone."""


def own_policy(hook: Callable[..., Any]) -> Policy:
    """Make a policy of the app's own hook, of either shape; what it may not answer fails a mission."""
    name = hook_name(hook)
    return _for_all(name, hook) if chooses_for_all(hook) else _trip_by_trip(name, hook)


def chooses_for_all(hook: Callable[..., object]) -> bool:
    """Return whether a policy is `(waiting, drones, now)`: it has three parameters without a default."""
    try:
        given = signature(hook).parameters.values()
    except (TypeError, ValueError):
        return False  # it does not say
    positional = [one for one in given if one.kind.name.startswith("POSITIONAL_O")]
    return sum(one.default is one.empty for one in positional) == 3


def _trip_by_trip(name: str, hook: Callable[[Any, Sequence[Drone]], Any]) -> OneByOne:
    def choose(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
        candidates = tuple(filter(able, free))
        if not candidates:
            return None
        drone = ask_policy(name, partial(hook, trip, candidates))
        if drone is None:
            return None
        if not any(drone is candidate for candidate in candidates):
            answer = f"drone {drone.id}" if type(drone) is Drone else class_of(drone)
            raise HookFault(
                f"policy {name} must return one of the candidates or None, not {answer}"
            )
        return drone, f"chosen by {name}"

    return choose


def _for_all(name: str, hook: Callable[..., Assignment]) -> Batch:
    def choose(
        requests: Sequence[Request], free: Sequence[Drone], queue: Queue
    ) -> Sequence[Choice | None]:
        question = _Question(name, requests, free, queue)
        chosen: Mapping[int, Drone] = {}
        if any(waiting.drones for waiting in question.waiting):
            try:
                chosen = question.ask(hook)
            except HookFault as fault:
                queue.refuse(requests[question.guilty], fault)
                queue.changed()  # it is asked again for the others
        why = f"chosen by {name}"
        return [(chosen[n], why) if n in chosen else None for n in range(len(requests))]

    return Batch(choose, of=hook)


class _Question:
    """One question to a policy for all."""

    def __init__(
        self, name: str, requests: Sequence[Request], free: Sequence[Drone], queue: Queue
    ) -> None:
        self.name = name
        self._queue = queue
        self._free = tuple(free)
        self.guilty = 0  # whose mission fails if the answer is wrong: it has waited longest
        self.waiting = tuple(
            Waiting(
                mission=one.mission,
                trip=one.trip,
                drones=tuple(filter(one.able, free)),
                since=one.since,
                priority=one.rank[0],
                deadline=one.mission.deadline,
            )
            for one in requests
        )

    def ask(self, hook: Callable[..., Assignment]) -> Mapping[int, Drone]:
        """Ask, and return the drones by the places of the trips; raise `HookFault`."""
        question = partial(hook, self.waiting, self._free, self._queue.kernel.now)
        after, pairs = ask_policy(self.name, partial(self._answer, question))
        chosen = dict[int, Drone]()
        for pair in pairs:
            place, drone = self._checked(pair, chosen)
            chosen[place] = drone
        self._ask_again(after, bool(chosen))
        return chosen

    def _answer(self, question: Callable[[], Any]) -> tuple[float | None, list[Any]]:
        answer = question()
        after = None
        if type(answer) is Again:
            after, answer = answer
        if isinstance(answer, Mapping):
            answer = answer.items()
        if isinstance(answer, (str, bytes)) or not isinstance(answer, Iterable):
            raise self._no_pairs(answer)
        pairs: Iterator[Any] = iter(answer)
        return after, [*islice(pairs, len(self.waiting) + 1)]  # one more is wrong in any case

    def _checked(self, pair: Any, chosen: Mapping[int, Drone]) -> tuple[int, Drone]:
        """Return the place of a trip, and its drone, if one may have the other."""
        if not (isinstance(pair, (tuple, list)) and len(pair) == 2):
            raise self._no_pairs(pair)
        waiting, drone = pair
        place = next((n for n, one in enumerate(self.waiting) if one is waiting), None)
        if place is None:
            who = _what(waiting)
            raise self._fault(f"gives a drone to {who}, which is none of those that wait")
        self.guilty = place
        trip = _named(waiting)
        if not any(drone is free for free in self._free):
            raise self._fault(f"gives {trip} {_what(drone)}, which is none of the free drones")
        if place in chosen:
            raise self._fault(f"gives {trip} two drones, {chosen[place].id} and {drone.id}")
        for other, its in chosen.items():
            if its is drone:
                both = f"{_named(self.waiting[other])} and {trip}"
                raise self._fault(f"gives drone {drone.id} twice, to {both}")
        if not any(drone is able for able in waiting.drones):
            raise self._fault(f"gives {trip} drone {drone.id}, which cannot fly it now")
        return place, drone

    def _ask_again(self, after: Any, gives: bool) -> None:
        plans = self._queue.plans
        kernel = self._queue.kernel
        timer, in_vain = plans.pop(("again", self.name), (None, 0))
        if timer is not None:
            timer.cancel()
        if after is None:
            return
        seconds = number_of(after)
        if seconds is None or seconds < SOONEST:
            wants = f"wants to be asked again after {_what(after)}"
            raise self._fault(f"{wants}: that must be a number of seconds, {SOONEST} or more")
        in_vain = 0 if gives else in_vain + 1
        if in_vain > MOST_IN_VAIN:
            wants = f"has asked {MOST_IN_VAIN:,} times to be asked again"
            raise self._fault(f"{wants}, and given no drone meanwhile")
        timer = kernel.at(kernel.now + seconds, EventKind.CLOCK, FLEET, self._queue.changed)
        plans["again", self.name] = (timer, in_vain)

    def _no_pairs(self, answer: object) -> HookFault:
        wanted = "must return pairs of a waiting trip and a drone"
        return self._fault(f"{wanted}, not {_what(answer)}")

    def _fault(self, what: str) -> HookFault:
        return HookFault(f"policy {self.name} {what}")


def _named(waiting: Waiting[Any, Any]) -> str:
    return f"trip {waiting.trip.name} of mission {quoted(waiting.mission.name)}"


def _what(value: object) -> str:
    """Return what a hook has answered, for a person."""
    if type(value) is Drone:
        return f"drone {value.id}"
    if type(value) is Waiting:
        return _named(value)
    return f"{value!r}" if type(value) in (int, float, type(None)) else class_of(value)
