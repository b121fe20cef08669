"""Each kind of alert arises from what the pages are shown, says why, and ends with its reason.

What people have acknowledged is known to all of them, and to the next station.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any, cast

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.attention import (
    KEPT,
    LONG,
    Attention,
    Cause,
    Waits,
    of_batteries,
    of_drones,
    of_missions,
    of_reserves,
    of_results,
    of_waiting,
)
from pluto_fleet.station.rows import words
from pluto_fleet.station.wire import Alert, DroneRow, MissionRow, Result, Words


def drone(
    id: str, status: str, why: str = "", ready_in: float | None = None, retired: bool = False
) -> DroneRow:
    row = {"id": id, "status": status, "x": 1.0, "y": 2.0, "battery": 0.4, "retired": retired}
    charges = {} if ready_in is None else {"ready_in": ready_in}
    return cast(DroneRow, {**row, "why": why, **charges})


def mission(
    name: str,
    status: str = "STANDBY",
    reason: str = "",
    *,
    wait: Words | None = None,
    late: bool = False,
    answers: list[str] | None = None,
    at: str = "allocate",
) -> MissionRow:
    row: dict[str, Any] = {
        "name": name,
        "status": status,
        "reason": reason,
        "at": [at],
        "wait": wait,
    }
    row |= {
        "trips": [{"name": "A", "x": 3.0, "y": 4.0}],
        "current": 0,
        "drone": None,
        "question": None,
    }
    if answers is not None:
        said = words("question.other", reason, question=reason)
        row["question"] = {"said": said, "answers": answers}
    return cast(MissionRow, {**row, "due": 30.0 if late else None, "late": late})


def result(number: int, *tags: str) -> Result:
    row = {"number": number, "mission": "North", "trip": "A", "drone": "cf1", "place": "Bed 3"}
    return cast(Result, {**row, "target": [5.0, 6.0, 1.0], "at": None, "tags": [*tags]})


class Listed:
    """A list of alerts, and a clock that goes on by a second with every look."""

    def __init__(self, file: Path) -> None:
        self.file, self.time, self.version = file, 0.0, 0
        self.attention = Attention(file, lambda: self.time)

    def again(self) -> None:
        """Begin anew from what was kept, as a station does that was started again."""
        self.attention, self.version = Attention(self.file, lambda: self.time), 0

    def look(self, causes: Iterable[Cause], flight: str = "f") -> list[Alert]:
        """Return the alerts that are not over."""
        self.time += 1
        self.version += 1
        self.attention.look(flight, causes, self.version)
        return [one for one in self.attention.rows if not one["over"]]


LOW, CHARGED = drone("cf3", "LOW", ready_in=250.0), drone("cf3", "FREE")


@pytest.mark.parametrize(
    ("causes", "none", "told"),
    [
        (
            of_drones([drone("cf1", "LOST", "its link was lost")], ()),
            of_drones([drone("cf1", "FREE")], ()),
            {"kind": "lost", "urgent": True, "drone": "cf1", "x": 1.0, "y": 2.0},
        ),
        (
            of_drones([drone("cf1", "LOST", "cf1 hit a wall")], ["cf1"]),
            of_drones([drone("cf1", "UNKNOWN")], ["cf1"]),
            {"kind": "crashed", "urgent": True, "drone": "cf1"},
        ),
        (
            of_batteries([LOW], True),
            of_batteries([CHARGED], True),
            {"kind": "battery", "urgent": False, "drone": "cf3"},
        ),
        (
            of_missions([mission("N", "UNCERTAIN", "Did it let go?", answers=["done"])]),
            of_missions([mission("N", "RUNNING")]),
            {"kind": "uncertain", "urgent": True, "mission": "N", "x": 3.0, "y": 4.0},
        ),
        (
            of_missions([mission("N", "FAILED", "no drone can do it", at="end")]),
            of_missions([mission("N", "UNEXECUTED")]),
            {"kind": "failed", "urgent": False, "mission": "N"},
        ),
        (
            of_missions([mission("N", late=True)]),
            of_missions([mission("N", "COMPLETED", late=True, at="end")]),
            {"kind": "late", "mission": "N"},
        ),
        ([of_waiting(9, [LOW], 0.5)], [], {"kind": "waiting", "mission": None, "drone": None}),
    ],
    ids=["lost", "crashed", "battery", "uncertain", "failed", "late", "waiting"],
)
def test_an_alert_lasts_as_long_as_its_reason(
    causes: Iterable[Cause], none: Iterable[Cause], told: dict[str, Any], tmp_path: Path
) -> None:
    listed = Listed(tmp_path / "attention.json")
    assert listed.look([]) == []
    [alert] = listed.look(causes)
    assert told.items() <= alert.items()
    assert (alert["since_at"], alert["by"], alert["over"]) == (2000, None, False)
    assert alert["said"]["key"] == f"alert.{told['kind']}" and alert["said"]["text"]
    assert listed.look(none) == []


def test_a_finding_lasts_until_a_person_knows_of_it(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    found = [result(4, "bloom", "pest")]
    [alert] = listed.look(of_results(found))
    assert (alert["kind"], alert["x"], alert["y"], alert["drone"]) == ("finding", 5.0, 6.0, "cf1")
    assert alert["said"]["text"] == 'bloom, pest: found by "North" at Bed 3'
    assert alert["said"]["facts"]["tags"] == ["bloom", "pest"]
    listed.attention.acknowledge(alert["id"], "Ana")
    assert listed.look(of_results(found)) == []
    assert listed.look(of_results([*found, result(5, "bloom")]))[0]["said"]["facts"]["number"] == 5


def test_a_broken_reserve_is_told_each_time_until_a_person_knows_of_it(tmp_path: Path) -> None:
    """Also when the drone has been charged since, and when the station was started anew."""
    listed = Listed(tmp_path / "attention.json")
    came = [(n, {"event": "drone.drained", "t": 9.0 * n, "drone": "cf1"}) for n in (1, 2)]
    drained = [(n, {**event, "level": 0.08 * n}) for n, event in came]
    [alert] = listed.look(of_reserves(drained[:1]))
    assert (alert["kind"], alert["drone"], alert["urgent"]) == ("drained", "cf1", False)
    assert alert["said"]["facts"] == {"drone": "cf1", "level": 0.08}
    assert alert["said"]["text"] == "cf1 came home with 8 % of its battery, less than its reserve"
    listed.again()
    assert listed.look(of_reserves(drained[:1])) == [alert]
    listed.attention.acknowledge(alert["id"], "Ana")
    [second] = listed.look(of_reserves(drained))
    assert second["said"]["facts"]["level"] == 0.16


def test_what_was_acknowledged_long_ago_does_not_arise_again(tmp_path: Path) -> None:
    listed, found = Listed(tmp_path / "attention.json"), [result(1, "bloom")]
    [alert] = listed.look(of_results(found))
    listed.attention.acknowledge(alert["id"], "Ana")
    for n in range(KEPT + 20):
        listed.look([*of_missions([mission(f"{n}", "FAILED")]), *of_results(found)])
    assert listed.look(of_results(found)) == []


def test_why_all_wait_is_said_in_total() -> None:
    drones = [drone(f"cf{n}", "LOW", ready_in=250.0 + n) for n in range(27)]
    drones += [drone("cf30", "BUSY"), drone("cf31", "LOST"), drone("cf32", "CHARGING")]
    cause = of_waiting(109, drones, 0.493)
    assert cause is not None
    assert cause.said["text"] == (
        "109 missions wait: 27 drones are below 50 %, the first is ready in about 4 min,"
        " 1 charging, 1 lost, 1 flying"
    )
    facts = {"missions": 109, "low": 27, "takes": 0.5, "ready_in": 240, "lost": 1, "flying": 1}
    assert facts.items() <= cause.said["facts"].items()
    never = of_waiting(2, [drone("cf1", "LOW")], 1.2)
    assert never is not None and never.said["text"] == "2 missions wait: 1 drone is too low"
    assert of_waiting(109, [drone("cf1", "BUSY"), drone("cf2", "FREE")], None) is None


def test_each_drone_that_keeps_missions_waiting_is_counted_once() -> None:
    """A lost one that was retired as well is lost; nothing is told while some drone can fly."""
    drones = [drone("cf1", "LOST", retired=True), drone("cf2", "FREE", retired=True)]
    drones += [drone("cf3", "RECOVERING"), drone("cf4", "OFFLINE"), drone("cf5", "RETURNING")]
    cause = of_waiting(1, drones, None)
    assert cause is not None
    assert cause.said["text"] == (
        "1 mission waits: 1 being recovered, 1 lost, 1 not asked yet, 1 retired, 1 flying"
    )


def test_a_battery_that_does_not_charge_says_where_to_look() -> None:
    [cause] = of_batteries([drone("cf3", "LOW")], True)
    assert cause.said["text"] == (
        "the battery of cf3 is too low for what waits; it does not charge:"
        " look whether it stands in its dock"
    )
    [cause] = of_batteries([drone(f"cf{n}", "LOW", ready_in=30.0) for n in range(5)], True)
    assert cause.said["text"] == (
        "the batteries of cf0, cf1, cf2 and 2 more are too low for what waits;"
        " the first is ready in about 30 s"
    )
    assert list(of_batteries([drone("cf3", "LOW")], False)) == []


def test_one_waits_for_long_in_the_time_of_its_flight() -> None:
    waits = Waits()
    waiting = [mission(name, wait=words("wait.drone", "waits for a drone")) for name in "ab"]
    assert waits.look(waiting[:1], 10.0) == 0 and waits.any
    assert waits.look(waiting, 9.0 + LONG) == 0
    assert waits.look(waiting, 10.0 + LONG) == 2
    assert waits.look([mission("a"), waiting[1]], 11.0 + LONG) == 0
    assert (
        waits.look([mission("a"), mission("b", wait=words("wait.paused", "paused"))], 12.0) == 0
        and not waits.any
    )


def lost() -> list[Cause]:
    return list(of_drones([drone("cf1", "LOST")], ()))


def test_an_acknowledgement_outlives_the_station_and_the_flight(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    [alert] = listed.look(lost())
    assert listed.attention.acknowledge(alert["id"], "Ana") == "acknowledged by Ana"
    assert listed.attention.acknowledge(alert["id"], "Ben") == "acknowledged already by Ana"
    listed.again()
    [after] = listed.look(lost(), flight="another")
    assert after == {**alert, "by": "Ana", "by_at": 1000}


def test_what_arises_again_is_another_alert(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    [first] = listed.look(lost())
    listed.attention.acknowledge(first["id"], "")
    assert listed.look([]) == []
    listed.again()
    [second] = listed.look(lost())
    assert second["id"] != first["id"] and second["by"] is None
    assert {one["id"] for one in listed.attention.rows} == {first["id"], second["id"]}


def test_pages_are_told_what_has_changed_and_no_more(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    [alert] = listed.look(lost())
    before = listed.version
    listed.look(lost())
    assert not list(listed.attention.rows.since(before))
    listed.look(of_drones([drone("cf1", "LOST", "it fell")], ()))
    assert len(list(listed.attention.rows.since(before))) == 1
    before = listed.version
    listed.attention.acknowledge(alert["id"], "Ana")
    listed.look(of_drones([drone("cf1", "LOST", "it fell")], ()))
    assert len(list(listed.attention.rows.since(before))) == 1


def test_of_what_is_over_the_newest_are_kept(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    for n in range(KEPT + 20):
        listed.look(of_missions([mission(f"{n}", "FAILED")]))
    kept: list[Alert] = list(listed.attention.rows)
    assert len(kept) == KEPT and kept[-1]["mission"] == f"{KEPT + 19}"


def test_what_is_no_alert_any_more_cannot_be_acknowledged(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r'there is no alert "x\\n" any more'):
        Listed(tmp_path / "attention.json").attention.acknowledge("x\n", "Ana")


@pytest.mark.parametrize("text", ["", "{}", "[1]", '[{"id": 1}]', "[]\x00"])
def test_a_file_that_cannot_be_read_keeps_no_one_from_flying(tmp_path: Path, text: str) -> None:
    (tmp_path / "attention.json").write_text(text)
    assert len(Listed(tmp_path / "attention.json").look(lost())) == 1
