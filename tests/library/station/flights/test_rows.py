"""What all pages see of a mission, and at which blocks it is: that is read off where its coroutine waits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

import pytest

from pluto_fleet.flight.simulation import Simulation
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.time.told import VirtualTime
from pluto_fleet.station.rows import blocks_of, living_row, recorded_row, words
from pluto_fleet.station.wire import MissionRow, Words
from plutoc.compile import analyse
from plutoc.source import Source
from tests.kit.apps import EXAMPLES, example


def record_of(status: str, *trips: Mapping[str, Any], **more: Any) -> dict[str, Any]:
    """Return the journal's record of a mission."""
    record = {"done": [], "todo": list(trips), "status": status, "reason": "", "ended": False}
    record |= {"at": None, "index": 0, "attempts": 1, "round": 0, "carrier": None}
    record |= {"promises": {}, "late": False, "fields": {}}
    return record | dict.fromkeys(("question", "held", "paused", "flight")) | more


def row(record: dict[str, Any], block: str, first: Sequence[str] = (), **more: Any) -> MissionRow:
    where = {"block": block, "drone": None, "flies": False, "allocated": False, "until": None}

    def why(mission: str, todo: Sequence[Mapping[str, Any]]) -> Words | None:
        return words("wait.drone", f"waits for a drone ({todo[0]['name']})") if todo else None

    return living_row("a", record, where | more, ("allocate",), 1, 10.0, why, first)


def text(seen: MissionRow) -> str:
    return "" if seen["wait"] is None else seen["wait"]["text"]


TRIP = {"name": "1", "action": "measure", "target": [1.0, 1.0, 1.0]}


def test_a_mission_waits_for_a_drone_that_can_do_its_next_trip() -> None:
    record = record_of("STANDBY", TRIP)
    block = "allocate"
    assert text(row(record, block)) == "waits for a drone (1)"
    assert row(record, block, allocated=True, drone="cf1")["wait"] is None
    assert row(record, block, flies=True, drone="cf1")["drone"] == "cf1"


def test_a_question_can_be_said_in_any_language() -> None:
    """Where a person must say what was done: by its facts; as it is where an app has something to ask."""
    flight = {"trip": "1", "drone": "cf1", "round": 0, "attempt": 1}
    doubtful = record_of("RUNNING", TRIP, question="was it done?", flight=flight)
    for record, key, facts in (
        (doubtful, "question.action", {"action": "measure", "trip": "1", "drone": "cf1"}),
        (
            record_of("STANDBY", TRIP, held="why?"),
            "question.other",
            {"question": "why?"},
        ),
    ):
        question = recorded_row("a", record, lives=True)["question"]
        assert question is not None
        assert (question["said"]["key"], question["said"]["facts"]) == (key, facts)


def test_a_delay_is_shown_as_long_as_it_lasts() -> None:
    record, block = record_of("UNEXECUTED", TRIP), "wait = Clock"
    assert text(row(record, block, until=12.0)) == "waits until its time has come"
    assert row(record, block, until=12.0)["until"] == 12.0
    assert row(record, block, until=10.0)["until"] is None


def test_a_mission_that_may_not_begin_yet_says_why() -> None:
    record = record_of("UNEXECUTED", TRIP, promises={"opens": 20.0, "deadline": 30.0})
    assert text(row(record, "")) == "waits until its time has come"
    assert (row(record, "")["until"], row(record, "")["due"]) == (20.0, 30.0)
    assert text(row(record, "", ["m", "n"])) == "comes after m, n"
    assert row(record, "wait = Clock", ["m"])["until"] is None


def test_a_trip_without_a_priority_of_its_own_has_the_usual_one() -> None:
    """A record leaves out what was not changed; what does not fly is not weighed either."""
    rows = row(record_of("STANDBY", TRIP), ""), recorded_row("a", record_of("STANDBY", TRIP))
    assert [seen["trips"][0]["priority"] for seen in rows] == [1, None]


def test_a_trip_is_shown_as_it_flies_only_while_its_brain_knows_that() -> None:
    record = record_of("RUNNING", {**TRIP, "status": "EXECUTING"})
    shown = [seen["trips"] for seen in (row(record, ""), recorded_row("a", record))]
    assert [trips[0]["status"] for trips in shown] == ["EXECUTING", "WAITING"]


@pytest.mark.parametrize(
    ("status", "ended", "shown"),
    [
        ("RUNNING", False, ("STANDBY", ["judge"])),
        ("COMPLETED", False, ("STANDBY", ["judge"])),
        ("COMPLETED", True, ("COMPLETED", ["end"])),
    ],
)
def test_what_was_judged_when_its_station_died_has_not_ended_either(
    status: str, ended: bool, shown: object
) -> None:
    seen = recorded_row("a", record_of(status, ended=ended, at="judge"))
    assert (seen["status"], seen["at"]) == shown


def test_a_mission_that_goes_on_is_shown_with_the_drone_that_has_its_item() -> None:
    record = record_of("STANDBY", carrier="cf1")
    assert recorded_row("a", record, lives=True)["drone"] == "cf1"
    assert recorded_row("a", record)["drone"] is None


def test_a_mission_is_only_ever_at_blocks_of_its_graph_be_it_in_a_fork() -> None:
    """Where it stands after each event of a flight."""
    flown, met = example("alfalfa"), set[tuple[str, ...]]()
    source = Source("app.pluto", (EXAMPLES / "alfalfa" / "app.pluto").read_text())
    blocks = {node.name for node in analyse(source)[0].graph.nodes}

    def look() -> None:
        met.update(tuple(blocks_of(one)) for one in simulation.brain.whereabouts().values())

    kernel = VirtualTime()
    simulation = Simulation(flown.app, flown.fleet, kernel, 0, Faults(), lambda event: None)
    kernel.settled = look
    kernel.run(simulation.start(deepcopy(flown.missions)), 100_000.0)
    simulation.close()
    assert {("wait",), ("watch", "timer")} <= met
    assert {block for at in met for block in at} <= blocks
