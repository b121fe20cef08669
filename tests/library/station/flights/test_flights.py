"""A station's flights, commanded as a page does: started, stopped, killed, gone on with."""

from __future__ import annotations

import json
import os
import shutil
import signal
from contextlib import closing
from dataclasses import replace
from itertools import count
from pathlib import Path
from resource import RLIM_INFINITY, RLIMIT_FSIZE, prlimit
from typing import Any

import pytest

from pluto_fleet.journal.lock import Lock
from pluto_fleet.journal.reader import Reader
from tests.kit.station import Station, until
from tests.library.station.flights.conftest import Serve

NUMBERS = count()


def tell(station: Station, what: str, **given: object) -> str:
    """Command something under a name of its own; return what is said."""
    status, answer = station.post(f"/api/{what}", {"id": f"test-{next(NUMBERS)}", **given})
    assert status == 200, answer
    return str(answer["said"])


def refused(station: Station, what: str, **given: object) -> tuple[int, str]:
    """Command what cannot be done."""
    status, answer = station.post(f"/api/{what}", {"id": f"test-{next(NUMBERS)}", **given})
    assert status != 200
    return status, str(answer["said"])


def events(station: Station, kind: str) -> list[dict[str, Any]]:
    """Return the events of one kind, of all flights."""
    found: list[dict[str, Any]] = []
    for journal in station.journals():
        with closing(Reader(journal)) as reader:
            found += [event for row in reader.rows() for event in json.loads(row.text)]
    return [event for event in found if event["event"] == kind]


def comes_to(station: Station, phase: str) -> None:
    until(lambda: station.phase == phase, f"the station is {phase}")


def row(station: Station, mission: str) -> dict[str, Any]:
    return next(row for row in station.now()["missions"] if row["name"] == mission)


def alerts(station: Station, kind: str) -> list[dict[str, Any]]:
    return [alert for alert in station.now()["alerts"] if alert["kind"] == kind]


def flies(station: Station) -> None:
    until(lambda: len(events(station, "trip.launched")) > 0, "something flies")


def flying(station: Station) -> Station:
    """Start the whole plan, and wait until something flies."""
    tell(station, "start")
    flies(station)
    return station


def each_trip_was_done_once(station: Station) -> bool:
    done = [(e["mission"], e["trip"], e["round"]) for e in events(station, "trip.completed")]
    twice_in_the_world = [deed for deed, times in station.done().items() if times > 1]
    return len(done) == len(set(done)) and not twice_in_the_world


def completes_all_once(station: Station) -> None:
    comes_to(station, "over")
    assert set(station.statuses().values()) == {"COMPLETED"}
    assert each_trip_was_done_once(station)


def test_what_cannot_be_kept_is_said_when_it_starts(serve: Serve) -> None:
    """On the console, and no more than that: it is flown all the same."""
    station = serve()
    plan = station.get("/api/plan")
    late, *_ = plan["missions"]
    late["deadline"] = "1 s"
    station.put("/api/plan", {name: plan[name] for name in ("revision", "missions")})
    said = tell(station, "start", missions=[late["key"]])
    assert said == "1 mission started; not all will be in time: the console says why"
    lines = [line["text"] for line in station.now()["log"]]
    why = f'Mission "{late["name"]}": it is due after 1 s, and takes'
    assert any(line.startswith(why) for line in lines), lines
    completes_all_once(station)
    assert row(station, late["name"])["late"]


def test_missions_fly_to_their_end_and_can_be_flown_once_more(serve: Serve) -> None:
    station = serve()
    assert station.phase == "idle"
    assert tell(station, "start") == "3 missions started"
    comes_to(station, "over")
    assert set(station.statuses().values()) == {"COMPLETED"}
    assert not any(mission["launched"] for mission in station.get("/api/plan")["missions"])
    assert tell(station, "start") == "3 missions started"
    comes_to(station, "over")
    assert len(station.journals()) == 2


def test_two_starts_start_once(serve: Serve) -> None:
    station = serve()
    assert tell(station, "start") == "3 missions started"
    assert tell(station, "start") == "every mission of the plan flies already"
    comes_to(station, "over")
    assert len(events(station, "mission.created")) == 3


def test_a_command_that_is_repeated_under_its_name_is_carried_out_once(serve: Serve) -> None:
    station = flying(serve())
    skip: dict[str, object] = {"id": "the-same", "mission": "Mission 1", "trip": "C"}
    first, again = station.post("/api/skip", skip), station.post("/api/skip", skip)
    assert first == again
    assert first[0] == 200
    assert len(events(station, "trip.skipped")) == 1


def test_all_fly_home_by_a_stop_and_go_on_where_they_were(serve: Serve) -> None:
    station = serve()
    homes = {drone["id"]: drone["home"] for drone in station.get("/api/app")["drones"]}
    flying(station)
    assert tell(station, "stop", how="rtl") == "stopping: all drones fly home and land"
    comes_to(station, "stopped")
    for drone in station.now()["drones"]:
        assert [drone["x"], drone["y"], drone["z"]] == homes[drone["id"]]
    assert refused(station, "start")[1].startswith("the last flight has not ended")
    assert tell(station, "resume") == "going on where it was"
    completes_all_once(station)


def test_motors_are_cut_one_drone_at_a_time_and_the_others_finish(serve: Serve) -> None:
    """The flight fails, the drone is lost until it is brought back, all others go on."""
    station = serve()
    assert refused(station, "cut-motors", drone="cf1") == (409, "nothing flies")
    flying(station)
    who = events(station, "trip.launched")[0]["drone"]
    assert tell(station, "cut-motors", drone=who) == f"the motors of {who} are cut"
    until(lambda: any(e["drone"] == who for e in events(station, "drone.lost")), "it is lost")
    assert refused(station, "cut-motors", drone="cf9")[1].startswith('no drone "cf9" is in the')
    until(lambda: alerts(station, "crashed") != [], "it is alerted of")
    [alert] = alerts(station, "crashed")
    assert (alert["drone"], alert["over"], alert["by_at"]) == (who, False, None)
    assert tell(station, "acknowledge", alert=alert["id"]) == "acknowledged"
    assert tell(station, "bring-back", drone=who) == f"{who} is asked whether it is well"
    comes_to(station, "over")
    station.kill()
    station.start()
    [after] = alerts(station, "crashed")
    assert (
        after["by_at"] is not None and {**after, "over": False, "by": None, "by_at": None} == alert
    )
    reasons = [event["reason"] for event in events(station, "trip.failed")]
    assert any(reason.startswith(f"{who}'s motors were cut") for reason in reasons)
    assert tuple(station.statuses().values()).count("COMPLETED") > 0


def test_a_killed_station_shows_what_was_interrupted_and_flies_nothing_before_it_is_told(
    serve: Serve,
) -> None:
    station = flying(serve())
    assert station.post("/api/retire", {"id": "before", "drone": "cf4"})[0] == 200
    station.kill()
    station.start()
    assert station.phase == "interrupted"
    assert all(mission["launched"] for mission in station.get("/api/plan")["missions"])
    assert [drone["retired"] for drone in station.now()["drones"]] == [False, False, False, True]
    launched = len(events(station, "trip.launched"))
    assert station.post("/api/retire", {"id": "before", "drone": "cf4"}) == (
        200,
        {"said": "done already"},
    )
    assert len(events(station, "trip.launched")) == launched
    tell(station, "resume")
    completes_all_once(station)


def test_what_was_interrupted_can_be_put_away_and_something_else_flown(serve: Serve) -> None:
    station = flying(serve())
    station.kill()
    station.start()
    assert tell(station, "discard") == "put away; its journal is kept"
    assert station.phase == "idle"
    station.kill()
    station.start()
    assert station.phase == "idle"
    assert tell(station, "start") == "3 missions started"
    comes_to(station, "over")


def test_ctrl_c_lands_all_drones_and_the_next_station_goes_on(serve: Serve) -> None:
    station = flying(serve())
    station.end()
    assert "stopping: the drones land where they are" in station.said()
    assert events(station, "stopped")[0]["how"] == "land"
    station.start()
    assert station.phase == "stopped"
    tell(station, "resume")
    comes_to(station, "over")
    assert each_trip_was_done_once(station)


def test_a_station_whose_folder_is_gone_ends_and_says_what_it_could_not_write(serve: Serve) -> None:
    station = serve()
    shutil.rmtree(station.folder)
    station.stop()
    assert "left: cannot be written: No such file or directory" in station.said()
    assert "internal error" not in station.said()


def test_a_supervised_station_goes_on_by_itself_when_it_is_killed(serve: Serve) -> None:
    station = flying(serve("drugs_distribution", "--supervise"))
    before = station.get("/api/app")["server"]
    serving = int((station.folder / "station" / "lock").read_text())
    assert serving != station.pid
    os.kill(serving, signal.SIGKILL)

    def is_another() -> bool:
        try:
            return bool(station.get("/api/app")["server"] != before)
        except OSError:
            return False

    until(is_another, "another process serves")
    completes_all_once(station)


def test_missions_that_were_drawn_meanwhile_set_out_beside_those_that_fly(serve: Serve) -> None:
    station = serve()
    tell(station, "start")
    plan = station.get("/api/plan")
    added = {
        "key": "added-mission",
        "name": "More",
        "trips": [{"key": "added-trip", "action": "measure", "target": [3, 5], "parameters": {}}],
    }
    drawn = {"revision": plan["revision"], "missions": [*plan["missions"], added]}
    assert station.put("/api/plan", drawn)[0] == 200
    flies(station)
    assert tell(station, "start") == "1 mission started"
    comes_to(station, "over")
    assert station.statuses()["More"] == "COMPLETED"
    assert len(station.journals()) == 1


def test_a_priority_can_be_changed_while_missions_fly_and_only_in_apps_that_have_one(
    serve: Serve,
) -> None:
    station = flying(serve("drugs_distribution_retry"))
    waiting = next(r for r in station.now()["missions"] if r["current"] is not None)
    trip = waiting["trips"][-1]["name"]
    tell(station, "prioritise", mission=waiting["name"], trip=trip, priority=7)
    assert row(station, waiting["name"])["trips"][-1]["priority"] == 7
    without = flying(serve())
    given = {"mission": "Mission 1", "trip": "A", "priority": 7}
    assert refused(without, "prioritise", **given) == (
        409,
        "the trips of this app have no priority",
    )


def test_no_other_station_serves_from_the_same_folder(serve: Serve) -> None:
    station = serve()
    other = Station(app=station.app, folder=station.folder, options=station.options)
    with pytest.raises(AssertionError, match="another station is being served from there"):
        other.start()


def test_a_port_that_is_taken_is_said_so(serve: Serve, tmp_path: Any) -> None:
    station = serve()
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    other = Station(app=station.app, folder=elsewhere, options=station.options, port=station.port)
    with pytest.raises(AssertionError, match=f"port {station.port} is taken"):
        other.start()


def test_a_flight_over_another_map_is_not_drawn_over_this_one(serve: Serve, tmp_path: Any) -> None:
    station = flying(serve())
    station.end()
    app = station.app
    fleet = tmp_path / "fleet.toml"
    text = app.fleet.read_text().replace("18.0, 10.0", "18.0, 11.0")
    fleet.write_text(text.replace('image = "map.svg"', ""))
    station.app = replace(app, fleet=fleet)
    station.start()
    assert station.phase == "idle"
    assert "the last flight is not shown: it has another map" in station.said()
    station.end()
    station.app = app
    station.start()
    assert station.phase == "stopped"


def test_what_was_gone_on_with_elsewhere_cannot_be_put_away(serve: Serve) -> None:
    station = flying(serve())
    tell(station, "stop", how="land")
    comes_to(station, "stopped")
    elsewhere = Lock.take(station.journals()[0])
    try:
        said = refused(station, "discard")[1]
        assert said.startswith("it was gone on with elsewhere")
    finally:
        elsewhere.release()
    assert tell(station, "discard") == "put away; its journal is kept"


def test_the_clock_does_not_go_back_when_all_drones_are_down(serve: Serve) -> None:
    station = flying(serve())
    tell(station, "stop", how="rtl")
    times = [station.now()["state"]["time"]]

    def is_stopped() -> bool:
        state = station.now()["state"]
        times.append(state["time"])
        return bool(state["phase"] == "stopped")

    until(is_stopped, "the station is stopped")
    assert times == sorted(times)


def test_no_other_user_may_look_into_the_folder_of_a_station(serve: Serve) -> None:
    station = serve("drugs_distribution")
    folder = station.folder / "one" / "more"
    other = replace(station, folder=folder, port=0)
    folder.parent.mkdir()
    other.start()
    try:
        assert folder.stat().st_mode & 0o777 == 0o700
    finally:
        other.end()


def test_what_could_not_be_written_down_is_not_shown_to_have_happened(serve: Serve) -> None:
    station = flying(serve("drugs_distribution", "--speed", "10"))
    prlimit(station.pid, RLIMIT_FSIZE, (60_000, RLIM_INFINITY))  # room to read it, none to go on
    comes_to(station, "interrupted")
    seen = station.now()
    assert "the journal cannot be written" in seen["state"]["said"]
    assert {mission["status"] for mission in seen["missions"]} == {"STANDBY"}
    prlimit(station.pid, RLIMIT_FSIZE, (RLIM_INFINITY, RLIM_INFINITY))
    tell(station, "resume")
    completes_all_once(station)


def test_an_unreadable_journal_keeps_no_station_from_being_served(
    serve: Serve, tmp_path: Path
) -> None:
    (tmp_path / "station0").mkdir()
    (tmp_path / "station0" / "old.journal").write_bytes(b"no journal at all")
    station = serve("drugs_distribution", "--supervise")
    assert "the last flight cannot be shown" in station.said()
    assert station.phase == "idle"
