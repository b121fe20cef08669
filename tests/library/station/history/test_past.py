"""Flights of the past by their journals alone: whole, damaged, or of something else."""

from __future__ import annotations

import json
import shutil
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from mcap.reader import make_reader

from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.shared.domain.actions import BUILT_IN
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.history.past import PastFlights
from pluto_fleet.station.shown import Shown
from tests.kit.journals import entry
from tests.kit.told import Told
from tests.library.files.an_app import APP, POLLINATE
from tests.library.station.plan.drawing import FLEET

FARM = replace(
    APP, name="farm", actions={**BUILT_IN, "sprinkle": replace(POLLINATE, name="sprinkle")}
)
OLD, NEW = "2026-01-01-120000", "2026-01-02-120000"

ROWS = Path(__file__).with_name("a_flight.jsonl")
"""A flight of the app `farm` that was stopped: of each row its time, and its events."""
TOLD = Path(__file__).with_name("a_flight.told.json")
"""What pages are told of it."""


def kept(folder: Path, id: str, *, measured: bool = True) -> Path:
    """Put the journal of that flight there, with or without what was measured."""
    path = folder / f"{id}.journal"
    (began, header), *rows = map(json.loads, ROWS.read_text("utf-8").splitlines())
    times = iter([began, *(time for time, *_ in rows)])
    store = Store.create(path, header, times.__next__)
    told = Told()
    for _, *events in rows:
        left = [one for one in events if measured or one["event"] != "drone.flew"]
        store.append([entry(left, told)])
    store.close()
    return path


def past_of(folder: Path) -> PastFlights:
    """Return what a station serves that has this folder."""
    config = StationConfig(folder=folder, fleet=FLEET, faults={})
    config.own_folder.mkdir(exist_ok=True)
    return PastFlights(FARM, config)


def parts_of(past: PastFlights, id: str) -> Iterator[list[dict[str, Any]]]:
    """Yield the frames of a whole replay, part by part."""
    start: float | None = 0.0
    while start is not None:
        part: Any = past.replay(id, start)
        yield part["frames"]
        start = part["next"]


def frames_of(past: PastFlights, id: str) -> list[dict[str, Any]]:
    """Return all frames of a replay."""
    return [frame for part in parts_of(past, id) for frame in part]


def test_what_is_told_of_a_flight_is_what_its_journal_tells(tmp_path: Path, update: bool) -> None:
    """In lists, hours, report and replay; what was not measured is not known: see a_flight.told.json."""
    kept(tmp_path, NEW)
    kept(tmp_path, OLD, measured=False)
    past = past_of(tmp_path)
    told: dict[str, Any] = {"flights": past.flights(), "hours": past.hours()}
    for id in (NEW, OLD):
        part: Any = past.replay(id, 0.0)
        frames = [json.dumps(frame) for frame in frames_of(past, id)]
        told[id] = {
            "report": past.report(id),
            "said": part["said"],
            "log": [json.dumps(line) for line in part["log"]],
            "console": past.console(id).splitlines(),
            "results": [json.dumps(one) for one in past.results(id)],
            "frames": [*frames[:40:4], *frames[-3:]],
        }
        assert len(part["results"]) == len(told[id]["results"])
    text = json.dumps(told, indent=1, ensure_ascii=False) + "\n"
    if update:
        TOLD.write_text(text, "utf-8")
    assert json.loads(text) == json.loads(TOLD.read_text("utf-8"))


def test_a_journal_is_read_once_and_again_when_it_has_grown(tmp_path: Path) -> None:
    """Also by the next station: it is read from a file what was read before."""
    journal = kept(tmp_path, NEW)
    [before] = past_of(tmp_path).flights()
    kept_file = tmp_path / "station" / "flights.json"
    told = json.loads(kept_file.read_text())
    told["flights"][NEW][1]["by"] = "what only the file says"
    kept_file.write_text(json.dumps(told))
    assert past_of(tmp_path).flights() == [{**before, "by": "what only the file says"}]
    store = Store.open(journal)
    fell = '[{"t": 900.0, "event": "drone.lost", "drone": "scout1", "reason": "it fell"}]'
    store.append([Entry(fell)])
    store.close()
    [after] = past_of(tmp_path).flights()
    assert (after["by"], after["lost"], after["seconds"]) == (None, ["scout1"], 900.0)


@pytest.mark.parametrize(
    "text", ["", "no JSON", "[]", '{"format": 1, "app": "farm", "flights": 3}']
)
def test_a_file_that_is_not_as_expected_is_made_anew(tmp_path: Path, text: str) -> None:
    kept(tmp_path, NEW)
    first = past_of(tmp_path).flights()
    (tmp_path / "station" / "flights.json").write_text(text)
    assert past_of(tmp_path).flights() == first


def test_a_journal_that_cannot_be_read_is_listed_with_what_is_wrong(tmp_path: Path) -> None:
    """The others are listed all the same, and hours are counted by them."""
    kept(tmp_path, NEW)
    (tmp_path / "none.journal").write_bytes(b"no journal at all")
    damaged = kept(tmp_path, "damaged")
    whole = bytearray(damaged.read_bytes())
    whole[len(whole) // 2 :] = b"\0" * (len(whole) - len(whole) // 2)
    damaged.write_bytes(whole)
    past = past_of(tmp_path)
    flights = {flight["id"]: flight for flight in past.flights()}
    assert flights[NEW]["said"] == ""
    for id in ("none", "damaged"):
        assert flights[id]["end"] == "unknown"
        assert f"{id}.journal" in flights[id]["said"]
        assert past.replay(id, 0.0)["said"] != ""
        assert past.report(id)["flight"]["end"] == "unknown"
    assert past.hours()


def test_another_apps_journal_is_listed_as_such(tmp_path: Path) -> None:
    kept(tmp_path, NEW)
    config = StationConfig(folder=tmp_path, fleet=FLEET, faults={})
    config.own_folder.mkdir()
    [flight] = PastFlights(APP, config).flights()
    assert flight["end"] == "unknown"
    assert "farm" in flight["said"]


@pytest.mark.parametrize("id", ["", "..", "../x", NEW + ".journal", "/etc/passwd", "\0", "x" * 999])
def test_an_id_is_looked_up_and_never_made_into_a_path(tmp_path: Path, id: str) -> None:
    kept(tmp_path, NEW)
    shutil.copyfile(tmp_path / f"{NEW}.journal", tmp_path.parent / "x.journal")
    past = past_of(tmp_path)
    for ask in (past.report, past.console, past.results, past.mcap):
        with pytest.raises(BadInput, match="there is no flight"):
            ask(id)
    with pytest.raises(BadInput, match="there is no flight"):
        past.replay(id, 0.0)


def test_who_commanded_what_is_told_by_journal_and_log(tmp_path: Path) -> None:
    """What only the journal has came from another program; edits of the plan are no commands."""
    journal = kept(tmp_path, NEW)
    past = past_of(tmp_path)
    begun_at = past.flights()[0]["begun_at"]
    assert begun_at is not None
    store = Store.open(journal)
    commanded = [
        {"t": 500.0, "event": "commanded", "id": id, "command": "pause"} for id in ("one", "two")
    ]
    store.append([Entry(json.dumps(commanded))])
    store.close()
    lines = [
        {"do": "/api/plan", "given": {}, "status": 200, "said": ""},
        {"do": "/api/start", "given": {"id": "start"}, "status": 200, "said": "started"},
        {"do": "/api/pause", "given": {"id": "one", "mission": "A"}, "status": 200, "said": "yes"},
        {"do": "/api/pause", "given": {"id": "no"}, "status": 409, "said": "nothing flies"},
    ]
    stamp = _utc(begun_at)
    log = [json.dumps({"time": stamp, "client": "127.0.0.1", **line}) for line in lines]
    (tmp_path / "station" / "audit.log").write_text("\n".join([*log, '{"torn']))
    found = past.report(NEW)["commands"]
    told = {(one["command"], one["client"], one["said"], one["time"]) for one in found}
    assert told == {
        ("start", "127.0.0.1", "started", None),
        ("pause", "127.0.0.1", "yes", 500.0),
        ("pause", None, "", 500.0),
    }


def _utc(at: int) -> str:
    return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(at / 1000))


def test_a_state_that_does_not_say_whether_it_flies_ends_a_replay_there() -> None:
    """And no page shows it."""
    with pytest.raises(ValueError, match="no state"):
        Shown().take({"event": "shown", "t": 1.0, "state": {}})


def test_an_mcap_file_is_read_by_its_own_library(tmp_path: Path) -> None:
    """With as many poses, results and lines as the replay has."""
    kept(tmp_path, NEW)
    past = past_of(tmp_path)
    frames = frames_of(past, NEW)
    counts: Counter[str] = Counter()
    poses, moved = [], 0
    begun_at = past.flights()[0]["begun_at"]
    assert begun_at is not None
    reader = make_reader(BytesIO(past.mcap(NEW)), validate_crcs=True)
    for schema, channel, message in reader.iter_messages():
        assert schema is not None
        assert schema.encoding == "jsonschema"
        assert message.log_time >= begun_at * 1_000_000
        counts[schema.name] += 1
        data = json.loads(message.data)
        if schema.name == "foxglove.PoseInFrame":
            poses.append((channel.topic, data["pose"]["position"]))
        moved += len(data.get("transforms", ()))
    rows = [row for frame in frames for row in frame["drones"] if row["x"] is not None]
    shown = [(f"/drones/{row['id']}/pose", {axis: row[axis] for axis in "xyz"}) for row in rows]
    assert poses == shown
    assert moved == len(rows)
    assert counts["foxglove.Log"] == len(past.console(NEW).splitlines())
    assert counts["pluto.Result"] == len(past.results(NEW))
    assert counts["pluto.Battery"] > 0
    assert counts["pluto.Mission"] > 0


def test_a_part_of_a_long_replay_is_no_larger_than_it_may_be(tmp_path: Path) -> None:
    """And the parts together are all of it."""
    journal = kept(tmp_path, NEW)
    store = Store.open(journal)
    for t in range(1_000, 1_600):
        drones = {f"cf{n}": {"id": f"cf{n}", "trips": t, "why": "x" * 100} for n in range(50)}
        store.append([Entry(json.dumps([{"t": t, "event": "shown", "drones": drones}]))])
    store.close()
    parts = list(parts_of(past_of(tmp_path), NEW))
    assert len(parts) > 2
    assert max(len(json.dumps(part)) for part in parts) < 1_200_000
    late = [frame["t"] for part in parts for frame in part if 1_000 <= frame["t"] < 1_599]
    assert late == [float(t) for t in range(1_000, 1_599)]


def test_the_journal_that_is_being_written_is_read_beside_its_writer(tmp_path: Path) -> None:
    """By no other way than SQLite, whose locks would be gone otherwise: the writer goes on."""
    journal = kept(tmp_path, NEW)
    store = Store.open(journal)
    past = past_of(tmp_path)
    try:
        assert past.flights()[0]["end"] == "flying"
        for t in (700.0, 701.0):
            store.append([Entry(f'[{{"t": {t}, "event": "drone.lost", "drone": "scout1"}}]')])
            assert past.flights()[0]["seconds"] == t
        assert past.replay(NEW, 0.0)["frames"]
        assert past.report(NEW)["flight"]["lost"] == ["scout1"]
    finally:
        store.close()
    assert past_of(tmp_path).flights()[0]["end"] == "stopped"
