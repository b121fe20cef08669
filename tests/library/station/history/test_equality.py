"""The replay of any instant, by the journal alone, is what the live page showed then: of each example, over all its lives."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, field
from io import BytesIO
from math import dist
from typing import Any

import pytest
from mcap.reader import make_reader

from pluto_fleet.flight.tracked import EVERY, MOVED, STILL
from pluto_fleet.station.shown import MOVING, Shown
from tests.kit.apps import NAMES
from tests.library.station.conftest import Serve
from tests.library.station.in_process import Flown

SPEED = 20
NEAR = 2.0
"""Metres that a drone may have flown since it was heard of."""
PACE = 0.5
"""Metres a second at which nothing moves that fast."""
ENDS = ("over", "stopped", "interrupted")


@dataclass(slots=True)
class Page:
    """What one page was shown of one flight, from each instant on."""

    station: Flown
    views: dict[float, Shown] = field(default_factory=dict)
    log: list[Any] = field(default_factory=list)
    results: list[Any] = field(default_factory=list)
    flight: str = ""
    seen: int = 0
    shown: Shown = field(default_factory=Shown)
    events: dict[str, Any] = field(default_factory=dict)
    tracks: list[Any] = field(default_factory=list)
    """What was tracked, of all looks."""

    def look(self) -> str:
        """Take what has changed, as a page does; return what goes on."""
        asked = {"seen": self.seen, "log": len(self.log), "results": len(self.results)}
        query = {name: str(number) for name, number in asked.items()}
        given = self.station.get("/api/live", flight=self.flight, **query)
        self.flight, self.seen = given["flight"], given["version"]
        self.log += given["log"]
        self.results += given["results"]
        for row in given["amended"]:
            self.results[row["number"] - 1] = row
        self.events |= {row["id"]: row for row in given["events"]}
        self.tracks += given.get("tracks", [])
        t = given["state"]["time"]
        self.shown.take_frame({**given, "t": t})
        self.views[t] = deepcopy(self.shown)
        return str(given["state"]["phase"])


def replayed(station: Flown, flight: str) -> list[dict[str, Any]]:
    """Fetch a whole replay, part by part, as a page does that plays it."""
    frames: list[dict[str, Any]] = []
    start: float | None = 0.0
    while start is not None:
        part = station.get("/api/flights/replay", flight=flight, start=str(start))
        assert part["said"] == ""
        frames += part["frames"]
        start = part["next"]
    return frames


def shown_at(frames: list[dict[str, Any]], t: float) -> Shown:
    """Return what a page shows of these frames at an instant."""
    shown = Shown()
    for frame in frames:
        if frame["t"] > t:
            break
        shown.take_frame(frame)
    return shown


def differences(view: Shown, shown: Shown) -> list[str]:
    """Return what is not as it was: a drone is on the straight way between what was measured."""
    found = []
    if {**shown.state, "time": 0} != {**view.state, "time": 0}:
        found.append(f"{view.t}: {view.state} is replayed as {shown.state}")
    if shown.rows["missions"] != view.rows["missions"]:
        found.append(f"{view.t}: {view.rows['missions']} is replayed as {shown.rows['missions']}")
    assert shown.rows["drones"].keys() == view.rows["drones"].keys()
    if view.state["phase"] in ENDS:
        return found  # a live page asks the gateway that is left how its drones are
    for id, row in view.rows["drones"].items():
        mine = shown.rows["drones"][id]
        stays = [{k: v for k, v in one.items() if k not in MOVING} for one in (row, mine)]
        if stays[0] != stays[1] or not is_near(row, mine):
            found.append(f"{view.t}: {row} is replayed as {mine}")
    return found


def is_near(row: Mapping[str, Any], mine: Mapping[str, Any]) -> bool:
    """Whether a drone is replayed near the place at which it was heard of last."""
    if row["x"] is None or mine["x"] is None:
        return mine["x"] is None
    places = [[one[axis] for axis in "xyz"] for one in (row, mine)]
    return dist(*places) <= NEAR


FEW = ("aerial_mapping", "alfalfa", "drugs_distribution_retry")


@pytest.mark.parametrize(
    "name", [one if one in FEW else pytest.param(one, marks=pytest.mark.long) for one in NAMES]
)
def test_the_replay_of_every_instant_is_what_was_shown(serve: Serve, name: str) -> None:
    """State, missions and drones; the console and the results, too, line by line."""
    station = serve(name, speed=SPEED)
    station.tell("start")
    page = Page(station)
    station.until(lambda: page.look() in ENDS or len(page.views) > 60, "enough was seen")
    if station.phase == "flying":
        station.tell("stop", how="land")
    station.until(lambda: page.look() in ENDS, "the flight has ended")
    frames = replayed(station, page.flight)
    views = [(view, shown_at(frames, t)) for t, view in page.views.items()]
    assert [one for view, shown in views for one in differences(view, shown)] == []
    assert len(views) >= 20
    first = station.get("/api/flights/replay", flight=page.flight)
    assert (first["log"], first["results"]) == (page.log, page.results)
    for t in sorted(page.views)[:: len(views) // 5]:  # as a page does that scrubs
        scrubbed = station.get("/api/flights/replay", flight=page.flight, start=str(t))["frames"][0]
        whole = shown_at(frames, t)
        rows = [list(whole.rows[kind].values()) for kind in ("missions", "drones")]
        assert [scrubbed["t"], scrubbed["missions"], scrubbed["drones"]] == [whole.t, *rows]


def test_what_moves_and_what_has_happened_is_replayed_as_it_was_told(serve: Serve) -> None:
    """Where each object was at each instant, as near as a place a second says it; and what came of each event."""
    station = serve("pursue", speed=SPEED)
    station.tell("start")
    page = Page(station)
    station.until(lambda: page.look() and len(page.events) >= 2, "something has happened")
    station.until(lambda: page.look() and any(track_of(page)), "something is followed")
    station.tell("events/intruder", at=[3, 3], fields={"kind": "dog"})
    station.tell("stop", how="land")
    station.until(lambda: page.look() in ENDS, "the flight has ended")
    replay = station.get("/api/flights/replay", flight=page.flight)
    assert replay["events"] == [*page.events.values()]
    assert [one["name"] for one in replay["events"] if one["fields"].get("kind") == "dog"]
    assert {name for one in replay["events"] for name in one["made"]} <= page.shown.rows[
        "missions"
    ].keys()
    ways = {one["id"]: one for one in replay["tracks"]}
    assert {one["id"]: one["kind"] for one in page.tracks} == dict.fromkeys(ways, "person")
    for one in page.tracks:
        known = [place for place in ways[one["id"]]["way"] if place[0] <= one["seen"]]
        t, *at = known[-1]
        assert one["seen"] - t < STILL
        assert dist(at, [one[axis] for axis in "xyz"]) <= PACE * EVERY + MOVED
        assert one["trail"][-1] == at[:2]
    file = station.ask("GET", "/api/flights/mcap", flight=page.flight).body
    topics = {channel.topic for _, channel, _ in make_reader(BytesIO(file)).iter_messages()}
    assert {"/events", *(f"/tracks/{id}/pose" for id in ways)} <= topics


def test_a_drone_that_follows_is_seen_in_the_replay_at_every_instant(serve: Serve) -> None:
    """Its legs are broken off again and again, as what it follows goes elsewhere."""
    station = serve("pursue", speed=SPEED)
    station.tell("start")
    page = Page(station)
    station.until(lambda: page.look() and len(track_of(page)) > 0, "something is followed")
    station.until(lambda: page.look() and (page.shown.t or 0.0) > 60, "it was followed for a while")
    station.tell("stop", how="land")
    station.until(lambda: page.look() in ENDS, "the flight has ended")
    frames = replayed(station, page.flight)
    for t, view in page.views.items():
        shown = shown_at(frames, t)
        for id, row in view.rows["drones"].items():
            assert row["x"] is None or shown.rows["drones"][id]["x"] is not None, (t, row)


def track_of(page: Page) -> list[str]:
    """Return the tracks that missions follow now, by the rows of these."""
    rows = [row for row in page.shown.rows["missions"].values() if row["drone"] is not None]
    now = [row["trips"][row["current"]] for row in rows if row["current"] is not None]
    return [trip["track"] for trip in now if "track" in trip]


def test_a_flight_is_replayed_over_all_its_lives(serve: Serve) -> None:
    """Between a death and the next life nothing is known of where drones are, and none is shown."""
    station = serve(speed=SPEED).flying()
    station.until(lambda: station.now()["state"]["time"] > 30, "it has flown for a while")
    station.kill()
    station.start()
    [flight] = station.get("/api/flights")
    assert flight["end"] == "interrupted"
    before = replayed(station, flight["id"])
    station.tell("resume")
    station.completes_all_once()
    after = replayed(station, flight["id"])
    for frame in before[:-1]:  # where a drone was on its last way is known once that has ended
        assert (
            shown_at(after, frame["t"]).rows["missions"]
            == shown_at(before, frame["t"]).rows["missions"]
        )
    left = next(frame for frame in after if frame["state"]["phase"] == "interrupted")
    assert left["t"] >= before[-1]["t"]
    assert {row["status"] for row in left["drones"]} <= {"UNKNOWN", "LANDED", "ALOFT"}
    [flight] = station.get("/api/flights")
    assert (flight["end"], flight["completed"]) == ("over", 3)
    assert station.ask("GET", "/api/flights/mcap", flight=flight["id"]).body.startswith(b"\x89MCAP")
