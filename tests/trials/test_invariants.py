"""Each invariant can fail: a sound trace has no violation, and each planted mistake is found."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import pytest

from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.trials.delay_rule import DelaysAreWaited
from pluto_fleet.trials.drone_rules import ItemsStayAboard, ServesOneMission, StaysDown
from pluto_fleet.trials.invariants import RULES, Invariants, violations
from pluto_fleet.trials.promise_rule import PromisesAreKept
from pluto_fleet.trials.rules import (
    AttemptsCountUp,
    CompletedDidEverything,
    EndsOnce,
    LimitsAreKept,
    NothingAfterTheEnd,
    Rule,
    Say,
    TripsDoNotOverlap,
)

Trace = Sequence[Event]
Change = Callable[[list[dict[str, object]]], None]

ITEMS = {"ward": {"pick": "bed"}}


def sound() -> list[dict[str, object]]:
    """A mission that fails once, brings an item with d1, is asked for one trip more, and is late."""

    def trip(kind: str, name: str, drone: str, attempt: int = 1, **more: object) -> Event:
        return {
            "event": f"trip.{kind}",
            "mission": "ward",
            "trip": name,
            "drone": drone,
            "round": 0,
            "attempt": attempt,
            **more,
        }

    def given(name: str, drone: str) -> Event:
        return {"event": "trip.allocated", "mission": "ward", "trip": name, "drone": drone}

    promised = {"opens": 3.0, "deadline": 16.5, "after": ["dusk"]}
    events: list[Event] = [
        {"event": "mission.created", "mission": "dusk", "trips": []},
        {"event": "mission.ended", "mission": "dusk", "status": "COMPLETED", "reason": ""},
        {"event": "mission.promised", "mission": "ward", **promised},
        {"event": "mission.created", "mission": "ward", "trips": ["pick", "bed"]},
        given("pick", "d0"),
        trip("launched", "pick", "d0"),
        trip("failed", "pick", "d0", reason="d0 crashed"),
        {"event": "drone.recovering", "drone": "d0"},
        {"event": "trip.reset", "mission": "ward", "trip": "pick", "attempt": 2},
        {"event": "drone.lost", "drone": "d0"},
        given("pick", "d1"),
        trip("launched", "pick", "d1", 2),
        trip("completed", "pick", "d1", 2),
        given("bed", "d1"),
        trip("launched", "bed", "d1"),
        trip("completed", "bed", "d1"),
        {"event": "drone.returning", "drone": "d1"},
        {"event": "mission.late", "mission": "ward", "deadline": 16.5},
        {"event": "mission.extended", "mission": "ward", "redo": [], "add": ["look"]},
        {"event": "drone.free", "drone": "d1"},
        given("look", "d1"),
        trip("launched", "look", "d1"),
        trip("completed", "look", "d1"),
        {"event": "drone.returning", "drone": "d1"},
        {"event": "mission.ended", "mission": "ward", "status": "COMPLETED", "reason": ""},
        {"event": "log", "mission": "ward", "text": "good night"},
    ]
    return [{"t": float(second), **event} for second, event in enumerate(events)]


def place(trace: Trace, kind: str, **facts: object) -> int:
    """Return where the first event of a kind, with these facts, stands."""
    return next(
        number
        for number, event in enumerate(trace)
        if event["event"] == kind and facts.items() <= event.items()
    )


def test_sound_trace_has_no_violation() -> None:
    """Failures, retries, items, added trips and late log lines are all in order."""
    assert violations(sound(), ITEMS) == []


def test_empty_trace_has_no_violation() -> None:
    """Where nothing happened nothing went wrong."""
    assert violations([], {}) == []


def back_in_time(trace: list[dict[str, object]]) -> None:
    """An event stands after a later one."""
    trace[5]["t"] = 0.5


def hangs(trace: list[dict[str, object]]) -> None:
    """The mission never ends."""
    del trace[place(trace, "mission.ended", mission="ward")]


def ends_twice(trace: list[dict[str, object]]) -> None:
    """The mission ends again."""
    trace.append(dict(trace[place(trace, "mission.ended", mission="ward")], t=99.0))


def begins_twice(trace: list[dict[str, object]]) -> None:
    """The mission is made once more after its first trip."""
    trace.append(dict(trace[place(trace, "mission.created", mission="ward")], t=99.0))


def is_impatient(trace: list[dict[str, object]]) -> None:
    """A trip flies before its delay is over."""
    delay = {"t": 0.5, "event": "trip.delayed", "mission": "ward", "trip": "pick", "until": 99.0}
    trace.insert(1, delay)


def ends_oddly(trace: list[dict[str, object]]) -> None:
    """The mission ends while it is on standby."""
    trace[place(trace, "mission.ended", mission="ward")]["status"] = "STANDBY"


def fails_silently(trace: list[dict[str, object]]) -> None:
    """The mission fails for no reason."""
    trace[place(trace, "mission.ended", mission="ward")].update(status="FAILED", reason=" ")


def complains(trace: list[dict[str, object]]) -> None:
    """The mission is completed and has a reason all the same."""
    trace[place(trace, "mission.ended", mission="ward")]["reason"] = "d0 crashed"


def haunts(trace: list[dict[str, object]]) -> None:
    """The mission is allocated a drone after its end."""
    event = trace[place(trace, "trip.allocated", trip="look")]
    trace.append(dict(event, t=99.0))


def flies_two_trips(trace: list[dict[str, object]]) -> None:
    """The second trip is launched while the first one flies."""
    del trace[place(trace, "trip.completed", trip="pick")]


def lands_without_a_flight(trace: list[dict[str, object]]) -> None:
    """A trip is completed that was never launched."""
    del trace[place(trace, "trip.launched", trip="look")]


def lands_another(trace: list[dict[str, object]]) -> None:
    """What ends is another drone's flight."""
    trace[place(trace, "trip.completed", trip="look")]["drone"] = "d2"


def ends_in_flight(trace: list[dict[str, object]]) -> None:
    """The mission ends while its trip flies."""
    del trace[place(trace, "trip.completed", trip="look")]


def fails_too_early(trace: list[dict[str, object]]) -> None:
    """A trip fails for a safe time that it has not flown."""
    reason = "trip pick took longer than its safe time of 3 min 20 s"
    trace[place(trace, "trip.failed")]["reason"] = reason


def is_free_in_the_air(trace: list[dict[str, object]]) -> None:
    """A drone is free before it has landed."""
    trace[place(trace, "drone.free")]["at"] = [1.0, 2.0, 1.2]


def gives_a_returning_drone(trace: list[dict[str, object]]) -> None:
    """A drone on its way home is given away."""
    del trace[place(trace, "drone.free")]


def gives_a_drone_twice(trace: list[dict[str, object]]) -> None:
    """Another mission gets the drone that the first one holds."""
    event = trace[place(trace, "trip.allocated", trip="pick", drone="d1")]
    trace.insert(trace.index(event) + 1, dict(event, mission="other"))


def flies_with_a_stolen_drone(trace: list[dict[str, object]]) -> None:
    """A trip is launched with a drone that its mission was not given."""
    trace[place(trace, "trip.launched", trip="look")]["drone"] = "d2"


def gives_a_recovering_drone(trace: list[dict[str, object]]) -> None:
    """A drone that recovers is given to the mission again."""
    for event in trace[place(trace, "trip.allocated", drone="d1") : place(trace, "drone.free")]:
        if event.get("drone") == "d1":
            event["drone"] = "d0"


def brings_back_the_lost(trace: list[dict[str, object]]) -> None:
    """A lost drone is free after all."""
    trace.insert(place(trace, "drone.lost") + 1, {"t": 6.5, "event": "drone.free", "drone": "d0"})


def miscounts(trace: list[dict[str, object]]) -> None:
    """The second flight of a trip calls itself the first."""
    for event in trace:
        if event.get("attempt") == 2:
            event["attempt"] = 1


def forgets_a_trip(trace: list[dict[str, object]]) -> None:
    """The mission is completed without the trip that was added."""
    del trace[
        place(trace, "trip.allocated", trip="look") : place(trace, "mission.ended", mission="ward")
    ]


def opens_too_soon(trace: list[dict[str, object]]) -> None:
    """The mission begins before its window."""
    trace[place(trace, "mission.promised")]["opens"] = 3.5


def overtakes(trace: list[dict[str, object]]) -> None:
    """The mission begins before the one that it comes after has completed."""
    trace[place(trace, "mission.ended")].update(status="FAILED", reason="it was called off")


def forgets_who_goes_first(trace: list[dict[str, object]]) -> None:
    """The mission that it comes after never ends."""
    del trace[place(trace, "mission.ended")]


def promises_again(trace: list[dict[str, object]]) -> None:
    """Another deadline takes the place of the first."""
    trace.append(dict(trace[place(trace, "mission.promised")], t=99.0))


def is_late_too_soon(trace: list[dict[str, object]]) -> None:
    """The mission is late before its deadline."""
    trace[place(trace, "mission.promised")]["deadline"] = 18.0


def is_late_twice(trace: list[dict[str, object]]) -> None:
    """The mission is late once more."""
    late = place(trace, "mission.late")
    trace.insert(late, dict(trace[late]))


def hides_that_it_is_late(trace: list[dict[str, object]]) -> None:
    """The mission ends after its deadline, and nothing is said of it."""
    del trace[place(trace, "mission.late")]


def swaps_drones_with_an_item_aboard(trace: list[dict[str, object]]) -> None:
    """One drone picks the item, and another one releases it."""
    for event in trace:
        if event.get("trip") == "bed":
            event["drone"] = "d2"


def serves_another_with_an_item_aboard(trace: list[dict[str, object]]) -> None:
    """The drone that has the item is given to another mission."""
    event = dict(trace[place(trace, "trip.allocated", trip="bed")], mission="other")
    trace.insert(place(trace, "trip.allocated", trip="bed"), event)


ITEMS_STAY = partial(ItemsStayAboard, ITEMS)

PLANTED: list[tuple[Change, Callable[[Say], Rule] | None, str]] = [
    (back_in_time, None, "comes after 4 s"),
    (hangs, EndsOnce, "ward ended 0 times"),
    (ends_twice, EndsOnce, "ward ended 2 times"),
    (begins_twice, EndsOnce, "ward was created once more"),
    (ends_oddly, EndsOnce, "ward ended STANDBY"),
    (fails_silently, EndsOnce, "failed without a reason"),
    (complains, EndsOnce, "says why it failed: d0 crashed"),
    (haunts, NothingAfterTheEnd, "ward had ended before trip.allocated"),
    (flies_two_trips, TripsDoNotOverlap, "ward launched bed during pick"),
    (lands_without_a_flight, TripsDoNotOverlap, "look of ward ended and was not in flight"),
    (lands_another, TripsDoNotOverlap, "look (d2, round 0, attempt 1) of ward ended, not look"),
    (ends_in_flight, TripsDoNotOverlap, "ward ended during look"),
    (is_impatient, DelaysAreWaited, "its delay is not over before 99 s"),
    (fails_too_early, LimitsAreKept, "failed after 1 s for a safe time of 3 min 20 s"),
    (is_free_in_the_air, StaysDown, "d1 is free in the air"),
    (gives_a_returning_drone, ServesOneMission, "before it was free again"),
    (gives_a_drone_twice, ServesOneMission, "to other while ward had it"),
    (flies_with_a_stolen_drone, ServesOneMission, "which did not have it"),
    (gives_a_recovering_drone, StaysDown, "with d0 after drone.lost"),
    (brings_back_the_lost, StaysDown, "d0 was lost before drone.free"),
    (miscounts, AttemptsCountUp, "flight 2 of pick of ward calls itself attempt 1"),
    (forgets_a_trip, CompletedDidEverything, "look 1 times to do"),
    (opens_too_soon, PromisesAreKept, "begins before its window, 3.5 s"),
    (overtakes, PromisesAreKept, "begins, and dusk before it is FAILED"),
    (forgets_who_goes_first, PromisesAreKept, "begins, and dusk before it is under way"),
    (promises_again, PromisesAreKept, "ward is promised something once more"),
    (is_late_too_soon, PromisesAreKept, "ward is late before its deadline"),
    (is_late_twice, PromisesAreKept, "ward is late once more"),
    (hides_that_it_is_late, PromisesAreKept, "was due at 16.5 s, and is not late"),
    (swaps_drones_with_an_item_aboard, ITEMS_STAY, "has its item aboard d1, yet takes d2"),
    (serves_another_with_an_item_aboard, ITEMS_STAY, "d1 has the item of ward, yet serves other"),
]


@pytest.mark.parametrize(
    ("plant", "rule", "sentence"), PLANTED, ids=[plant.__name__ for plant, _, _ in PLANTED]
)
def test_planted_mistake_is_found(
    plant: Change, rule: Callable[[Say], Rule] | None, sentence: str
) -> None:
    """The rule finds the mistake, says what it is, and the whole of them reports it too."""
    trace = sound()
    plant(trace)
    invariants = Invariants(ITEMS, rules=[rule] if rule else [])
    for event in trace:
        invariants.take(event)
    found = invariants.over()
    assert any(sentence in text for text in found), found
    assert set(found) <= set(violations(trace, ITEMS))


def test_every_rule_is_shown_to_fail() -> None:
    """No rule stands there that nothing could violate."""
    assert {rule for _, rule, _ in PLANTED} == {*RULES, ITEMS_STAY, None}
