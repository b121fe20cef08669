"""Each invariant can fail: a sound trace has no violation, and each planted mistake is found."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import pytest

from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.trials.drone_rules import ItemsStayAboard, ServesOneMission, StaysDown
from pluto_fleet.trials.invariants import RULES, Invariants, violations
from pluto_fleet.trials.rules import (
    AttemptsCountUp,
    CompletedDidEverything,
    EndsOnce,
    EventsHappenOnce,
    LimitsAreKept,
    NothingAfterTheEnd,
    Rule,
    Say,
    TripsDoNotOverlap,
)
from pluto_fleet.trials.time_rules import DelaysAreWaited, PromisesAreKept

Trace = Sequence[Event]
Events = list[dict[str, object]]
Change = Callable[[Events], None]

ITEMS = {"ward": {"pick": "bed"}}


def sound() -> Events:
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

    promised = {"opens": 5.0, "deadline": 18.5, "after": ["dusk"]}
    events: list[Event] = [
        {"event": "event.raised", "id": "door"},
        {"event": "event.over", "id": "door", "made": "dusk"},
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
        {"event": "mission.late", "mission": "ward", "deadline": 18.5},
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


PLANTED: dict[str, tuple[Change, Callable[[Say], Rule] | None, str]] = {}
ITEMS_STAY = partial(ItemsStayAboard, ITEMS)


def planted(sentence: str, rule: Callable[[Say], Rule] | None = None) -> Callable[[Change], Change]:
    """Say which rule finds a mistake in a trace, and in which words."""

    def known(change: Change) -> Change:
        PLANTED[change.__name__.replace("_", " ")] = change, rule, sentence
        return change

    return known


@planted("comes after 4 s")
def back_in_time(trace: Events) -> None:
    trace[5]["t"] = 0.5


@planted("ward ended 0 times", EndsOnce)
def hangs(trace: Events) -> None:
    del trace[place(trace, "mission.ended", mission="ward")]


@planted("ward ended 2 times", EndsOnce)
def ends_twice(trace: Events) -> None:
    trace.append(dict(trace[place(trace, "mission.ended", mission="ward")], t=99.0))


@planted("ward was created once more", EndsOnce)
def begins_twice(trace: Events) -> None:
    trace.append(dict(trace[place(trace, "mission.created", mission="ward")], t=99.0))


@planted("its delay is not over before 99 s", DelaysAreWaited)
def is_impatient(trace: Events) -> None:
    delay = {"t": 0.5, "event": "trip.delayed", "mission": "ward", "trip": "pick", "until": 99.0}
    trace.insert(1, delay)


@planted("ward ended STANDBY", EndsOnce)
def ends_oddly(trace: Events) -> None:
    trace[place(trace, "mission.ended", mission="ward")]["status"] = "STANDBY"


@planted("failed without a reason", EndsOnce)
def fails_silently(trace: Events) -> None:
    trace[place(trace, "mission.ended", mission="ward")].update(status="FAILED", reason=" ")


@planted("says why it failed: d0 crashed", EndsOnce)
def complains(trace: Events) -> None:
    trace[place(trace, "mission.ended", mission="ward")]["reason"] = "d0 crashed"


@planted("ward had ended before trip.allocated", NothingAfterTheEnd)
def haunts(trace: Events) -> None:
    event = trace[place(trace, "trip.allocated", trip="look")]
    trace.append(dict(event, t=99.0))


@planted("ward launched bed during pick", TripsDoNotOverlap)
def flies_two_trips(trace: Events) -> None:
    del trace[place(trace, "trip.completed", trip="pick")]


@planted("look of ward ended and was not in flight", TripsDoNotOverlap)
def lands_without_a_flight(trace: Events) -> None:
    del trace[place(trace, "trip.launched", trip="look")]


@planted("look (d2, round 0, attempt 1) of ward ended, not look", TripsDoNotOverlap)
def lands_another(trace: Events) -> None:
    trace[place(trace, "trip.completed", trip="look")]["drone"] = "d2"


@planted("ward ended during look", TripsDoNotOverlap)
def ends_in_flight(trace: Events) -> None:
    del trace[place(trace, "trip.completed", trip="look")]


@planted("failed after 1 s for a safe time of 3 min 20 s", LimitsAreKept)
def fails_too_early(trace: Events) -> None:
    reason = "trip pick took longer than its safe time of 3 min 20 s"
    trace[place(trace, "trip.failed")]["reason"] = reason


@planted("d1 is free in the air", StaysDown)
def is_free_in_the_air(trace: Events) -> None:
    trace[place(trace, "drone.free")]["at"] = [1.0, 2.0, 1.2]


@planted("before it was free again", ServesOneMission)
def gives_a_returning_drone(trace: Events) -> None:
    del trace[place(trace, "drone.free")]


@planted("to other while ward had it", ServesOneMission)
def gives_a_drone_twice(trace: Events) -> None:
    event = trace[place(trace, "trip.allocated", trip="pick", drone="d1")]
    trace.insert(trace.index(event) + 1, dict(event, mission="other"))


@planted("which did not have it", ServesOneMission)
def flies_with_a_stolen_drone(trace: Events) -> None:
    trace[place(trace, "trip.launched", trip="look")]["drone"] = "d2"


@planted("with d0 after drone.lost", StaysDown)
def gives_a_recovering_drone(trace: Events) -> None:
    for event in trace[place(trace, "trip.allocated", drone="d1") : place(trace, "drone.free")]:
        if event.get("drone") == "d1":
            event["drone"] = "d0"


@planted("d0 was lost before drone.free", StaysDown)
def brings_back_the_lost(trace: Events) -> None:
    trace.insert(place(trace, "drone.lost") + 1, {"t": 11.5, "event": "drone.free", "drone": "d0"})


@planted("flight 2 of pick of ward calls itself attempt 1", AttemptsCountUp)
def miscounts(trace: Events) -> None:
    for event in trace:
        if event.get("attempt") == 2:
            event["attempt"] = 1


@planted("flight 1 of look of ward calls itself attempt 2", AttemptsCountUp)
def charges_an_interruption(trace: Events) -> None:
    launch = place(trace, "trip.launched", trip="look")
    again = [
        {"t": trace[launch]["t"], "event": "trip.interrupted", "mission": "ward", "trip": "look"},
        dict(trace[launch], attempt=2),
    ]
    trace[launch + 1 : launch + 1] = again
    trace[place(trace, "trip.completed", trip="look")]["attempt"] = 2


@planted("event door happens once more", EventsHappenOnce)
def happens_twice(trace: Events) -> None:
    trace.insert(1, dict(trace[0]))


@planted("event window has not happened, and is over", EventsHappenOnce)
def reacts_to_nothing(trace: Events) -> None:
    trace[1]["id"] = "window"


@planted("mission dusk is made once more, of event door", EventsHappenOnce)
def makes_a_mission_twice(trace: Events) -> None:
    trace.insert(2, dict(trace[1]))


@planted("mission dawn was made of an event, and has not begun", EventsHappenOnce)
def loses_a_mission(trace: Events) -> None:
    trace[1]["made"] = "dawn"


@planted("look 1 times to do", CompletedDidEverything)
def forgets_a_trip(trace: Events) -> None:
    del trace[
        place(trace, "trip.allocated", trip="look") : place(trace, "mission.ended", mission="ward")
    ]


@planted("begins before its window, 5.5 s", PromisesAreKept)
def opens_too_soon(trace: Events) -> None:
    trace[place(trace, "mission.promised")]["opens"] = 5.5


@planted("begins, and dusk before it is FAILED", PromisesAreKept)
def overtakes(trace: Events) -> None:
    trace[place(trace, "mission.ended")].update(status="FAILED", reason="it was called off")


@planted("begins, and dusk before it is under way", PromisesAreKept)
def forgets_who_goes_first(trace: Events) -> None:
    del trace[place(trace, "mission.ended")]


@planted("ward is promised something once more", PromisesAreKept)
def promises_again(trace: Events) -> None:
    trace.append(dict(trace[place(trace, "mission.promised")], t=99.0))


@planted("ward is late before its deadline", PromisesAreKept)
def is_late_too_soon(trace: Events) -> None:
    trace[place(trace, "mission.promised")]["deadline"] = 20.0


@planted("ward is late once more", PromisesAreKept)
def is_late_twice(trace: Events) -> None:
    late = place(trace, "mission.late")
    trace.insert(late, dict(trace[late]))


@planted("was due at 18.5 s, and is not late", PromisesAreKept)
def hides_that_it_is_late(trace: Events) -> None:
    del trace[place(trace, "mission.late")]


@planted("has its item aboard d1, yet takes d2", ITEMS_STAY)
def swaps_drones_with_an_item_aboard(trace: Events) -> None:
    for event in trace:
        if event.get("trip") == "bed":
            event["drone"] = "d2"


@planted("d1 has the item of ward, yet serves other", ITEMS_STAY)
def serves_another_with_an_item_aboard(trace: Events) -> None:
    event = dict(trace[place(trace, "trip.allocated", trip="bed")], mission="other")
    trace.insert(place(trace, "trip.allocated", trip="bed"), event)


@pytest.mark.parametrize(("plant", "rule", "sentence"), PLANTED.values(), ids=PLANTED)
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
    assert {rule for _, rule, _ in PLANTED.values()} == {*RULES, ITEMS_STAY, None}
