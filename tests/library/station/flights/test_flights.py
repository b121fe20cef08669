"""A station's flights, commanded as a page does: started, stopped, broken off, gone on with."""

from __future__ import annotations

import asyncio
from csv import DictReader
from typing import Any

import pytest

from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.lock import Lock
from pluto_fleet.station.session import FlightSession
from tests.library.station.conftest import Serve
from tests.library.station.in_process import Flown


def alerts(station: Flown, kind: str) -> list[dict[str, Any]]:
    return [alert for alert in station.now()["alerts"] if alert["kind"] == kind]


def drawn_also(station: Flown, **mission: object) -> None:
    """Draw one more mission."""
    trip = {"key": "added-trip", "action": "measure", "target": [3, 5], "parameters": {}}
    added = {"key": "added-mission", "name": "More", "trips": [trip], **mission}
    station.plan([*station.missions, added])


def test_what_cannot_be_kept_is_said_when_it_starts(serve: Serve) -> None:
    """On the console, and no more than that: it is flown all the same."""
    station = serve()
    drawn_also(station, deadline="1 s")
    said = station.tell("start", missions=["added-mission"])
    assert said == "1 mission started; not all will be in time: the console says why"
    why = 'Mission "More": it is due after 1 s, and takes'
    assert any(line["text"].startswith(why) for line in station.now()["log"])
    station.completes_all_once()
    assert station.mission("More")["late"]


def test_missions_fly_to_their_end_and_can_be_flown_once_more(serve: Serve) -> None:
    """Two Starts start once; those that were drawn meanwhile set out beside those that fly."""
    station = serve()
    assert station.phase == "idle"
    assert station.tell("start") == "3 missions started"
    assert station.tell("start") == "every mission of the plan flies already"
    drawn_also(station)
    assert station.refused("start").startswith("the drones are just being asked")
    station.until(lambda: not station.now()["state"]["busy"], "they have been asked")
    assert station.tell("start") == "1 mission started"
    station.completes_all_once()
    assert len(station.events("mission.created")) == 4 and len(station.journals()) == 1
    assert not any(mission["launched"] for mission in station.missions)
    assert station.tell("start") == "4 missions started"
    station.comes_to("over")
    assert len(station.journals()) == 2


def test_a_start_is_refused_that_was_asked_for_on_another_plan(serve: Serve) -> None:
    station = serve()
    revision = station.get("/api/plan")["revision"]
    drawn_also(station)
    assert "the plan has changed meanwhile" in station.refused("start", revision=revision)
    station.put("/api/plan", {"revision": revision + 1, "missions": []})
    assert "there is no mission yet" in station.refused("start")
    assert station.phase == "idle"


def test_all_fly_home_by_a_stop_and_go_on_where_they_were(serve: Serve) -> None:
    """The clock does not go back meanwhile, though the drones are down."""
    station = serve(speed=3.0).flying()
    station.until(lambda: any(one["z"] > 1 for one in station.now()["drones"]), "one is up")
    homes = {drone["id"]: drone["home"] for drone in station.get("/api/app")["drones"]}
    assert station.tell("stop", how="rtl") == "stopping: all drones fly home and land"
    assert station.phase == "stopping"
    assert "the drones are coming down" in station.refused("start")
    times = [0.0]

    def is_stopped() -> bool:
        state = station.now()["state"]
        times.append(state["time"])
        return bool(state["phase"] == "stopped")

    station.until(is_stopped, "the station is stopped")
    assert times == sorted(times)
    for drone in station.now()["drones"]:
        assert [drone["x"], drone["y"], drone["z"]] == homes[drone["id"]]
    assert station.refused("start").startswith("the last flight has not ended")
    assert "resume the flight first" in station.refused("pause", mission="Mission 1")
    assert station.tell("resume") == "going on where it was"
    station.completes_all_once()


def test_motors_are_cut_one_drone_at_a_time_and_the_others_finish(serve: Serve) -> None:
    """The flight fails, the drone is lost until it is brought back, all others go on."""
    station = serve()
    assert station.refused("cut-motors", drone="cf1") == "nothing flies"
    station.flying()
    who = station.events("trip.launched")[0]["drone"]
    assert station.tell("cut-motors", drone=who) == f"the motors of {who} are cut"
    station.until(lambda: alerts(station, "crashed"), "it is alerted of")
    assert station.refused("cut-motors", drone="cf9").startswith('no drone "cf9" is in the')
    [alert] = alerts(station, "crashed")
    assert (alert["drone"], alert["over"], alert["by_at"]) == (who, False, None)
    assert station.tell("acknowledge", alert=alert["id"]) == "acknowledged"
    assert station.tell("bring-back", drone=who) == f"{who} is asked whether it is well"
    station.comes_to("over")
    station.start()
    [after] = alerts(station, "crashed")
    assert after["by_at"] is not None
    assert {**after, "over": False, "by": None, "by_at": None} == alert
    reasons = [event["reason"] for event in station.events("trip.failed")]
    assert any(reason.startswith(f"{who}'s motors were cut") for reason in reasons)
    assert "COMPLETED" in station.statuses().values()


def test_a_broken_reserve_is_told_until_somebody_has_seen_it_and_beside_its_result(
    serve: Serve,
) -> None:
    """To a page that knows the result already, in the files, in the replay, and by the next station."""
    station = serve().flying()
    station.until(lambda: station.get("/api/results.json"), "a result is there")
    seen = station.now()
    drone = seen["results"][0]["drone"]
    body = station.world.bodies[drone]
    data: dict[str, Any] = body.data
    level, *drains = data["charge"]
    body.restore({**data, "charge": [level - body.battery_level + 0.15, *drains]})
    station.until(lambda: alerts(station, "drained"), "it is alerted of")
    [alert] = alerts(station, "drained")
    assert (alert["drone"], alert["over"]) == (drone, False)
    asked = {"flight": seen["flight"], "seen": str(seen["version"]), "log": "0", "results": "999"}
    [amended] = station.get("/api/live", **asked)["amended"]
    left = alert["said"]["facts"]["level"]
    assert (amended["drone"], amended["drained"]) == (drone, pytest.approx(left, abs=1e-4))
    station.tell("acknowledge", alert=alert["id"])
    station.until(lambda: alerts(station, "drained")[0]["over"], "it is over")
    station.comes_to("over")
    station.start()
    replay = station.get("/api/flights/replay", flight=seen["flight"])
    assert any(one["id"] == alert["id"] for one in replay["alerts"])
    past = station.get("/api/results.json", flight=seen["flight"])
    for results in (station.now()["results"], past, replay["results"]):
        [row] = [one for one in results if one["drained"] is not None]
        assert row["number"] == amended["number"]
    assert [one["over"] for one in alerts(station, "drained")] == [True]
    reply = station.ask("GET", "/api/results.csv", flight=seen["flight"])
    table = DictReader(reply.body.decode("utf-8-sig").splitlines())
    assert sum(line["drained"] != "" for line in table) == 1


def test_what_was_interrupted_is_shown_and_flies_when_it_is_told_or_is_put_away(
    serve: Serve,
) -> None:
    station = serve().flying()
    retire: dict[str, object] = {"id": "before", "drone": "cf4"}
    assert station.post("/api/retire", retire)[0] == 200
    station.kill()
    station.start()
    assert station.phase == "interrupted"
    assert all(mission["launched"] for mission in station.missions)
    assert [drone["retired"] for drone in station.now()["drones"]] == [False, False, False, True]
    launched = len(station.events("trip.launched"))
    assert station.post("/api/retire", retire) == (200, {"said": "done already"})
    station.tell("resume")
    station.until(lambda: len(station.events("trip.launched")) > launched, "it goes on")
    assert station.tell("resume") == "it goes on already"
    station.tell("stop", how="land")
    station.comes_to("stopped")
    elsewhere = Lock.take(station.journals()[0])
    assert station.refused("discard").startswith("it was gone on with elsewhere")
    elsewhere.release()
    assert station.tell("discard") == "put away; its journal is kept"
    assert station.refused("discard") == "there is nothing to put away"
    assert station.refused("resume") == "there is nothing to go on with"
    station.start()
    assert station.phase == "idle"
    assert station.tell("start").startswith(("1 mission", "2 missions", "3 missions"))
    station.comes_to("over")


def test_a_priority_can_be_changed_while_missions_fly_and_only_in_apps_that_have_one(
    serve: Serve,
) -> None:
    station = serve("drugs_distribution_retry").flying()
    waiting = next(r for r in station.now()["missions"] if r["current"] is not None)
    trip = waiting["trips"][-1]["name"]
    station.tell("prioritise", mission=waiting["name"], trip=trip, priority=7)
    assert station.mission(waiting["name"])["trips"][-1]["priority"] == 7
    without = serve(folder="other").flying()
    said = without.refused("prioritise", mission="Mission 1", trip="A", priority=7)
    assert said == "the trips of this app have no priority"


def test_a_flight_over_another_map_is_not_drawn_over_this_one(
    serve: Serve, capfd: pytest.CaptureFixture[str]
) -> None:
    station = serve().flying()
    station.end()
    ours = station.fleet.read_text()
    assert "18.0, 10.0" in ours
    station.fleet.write_text(ours.replace("18.0, 10.0", "18.0, 11.0"))
    station.start()
    assert station.phase == "idle"
    assert "the last flight is not shown: it has another map" in capfd.readouterr().err
    station.fleet.write_text(ours)
    station.start()
    assert station.phase == "stopped"


def test_an_unreadable_journal_keeps_no_station_from_being_served(
    serve: Serve, capfd: pytest.CaptureFixture[str]
) -> None:
    station = serve()
    (station.folder / "old.journal").write_bytes(b"no journal at all")
    station.start()
    assert "the last flight cannot be shown" in capfd.readouterr().err
    assert station.phase == "idle"


def test_what_could_not_be_written_down_is_not_shown_to_have_happened(
    serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    station = serve().flying()
    with monkeypatch.context() as full:
        full.setattr("pluto_fleet.journal.store.Store.append", _no_room)
        station.comes_to("interrupted")
    seen = station.now()
    assert "the journal cannot be written" in seen["state"]["said"]
    assert {mission["status"] for mission in seen["missions"]} == {"STANDBY"}
    station.tell("resume")
    station.completes_all_once()


def _no_room(store: Any, rows: object) -> None:
    raise JournalError(f"{store.path}: the journal cannot be written: no room")


def test_a_mistake_in_what_is_shown_leaves_no_page_waiting_and_the_flight_flies_on(
    serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    station, complaints = serve().flying(), list[object]()
    station.world.loop.set_exception_handler(lambda _, about: complaints.append(about))
    with monkeypatch.context() as wrong:
        wrong.setattr(FlightSession, "look", lambda *_: 1 / 0)
        assert station.now()["state"]["phase"] == "flying"
        station.comes_to("over")
    assert complaints
    station.completes_all_once()


def test_a_page_that_has_seen_all_is_answered_when_something_changes_or_in_a_second(
    serve: Serve,
) -> None:
    station = serve()
    seen, loop = int(station.now()["version"]), station.world.loop

    async def answered(change: bool) -> float:
        """Return how long a page waits, if something changes soon or nothing does."""
        begun = loop.time()
        asked = asyncio.ensure_future(station.life.newer("", seen, 0, 0))
        await asyncio.sleep(0.1)
        if change:
            station.life.plan.example(station.life.plan.revision)
        await asked
        return loop.time() - begun

    assert station.world.run(answered(change=False)) == pytest.approx(1.1, abs=0.1)
    assert station.world.run(answered(change=True)) == pytest.approx(0.2, abs=0.1)
