"""What has not been completed is flown again alone; what was completed, only by choice."""

from __future__ import annotations

from typing import Any

from tests.library.station.conftest import Serve
from tests.library.station.in_process import Flown


def test_what_was_not_completed_flies_again_alone_by_the_next_station_too(serve: Serve) -> None:
    """Nothing is flown twice but what a person chose, and then from its beginning."""
    station = serve().flying()
    keys = station.keys()
    one = keys["Mission 1"]
    assert "belongs to the flight that is under way" in station.refused("start", missions=[one])
    station.tell("cancel", mission="Mission 1")
    station.comes_to("over")
    ends = {"Mission 1": "CANCELLED", "Mission 2": "COMPLETED", "Mission 3": "COMPLETED"}
    assert station.ends() == ends
    station.start()
    assert station.ends() == ends
    assert station.tell("start") == "1 mission started"
    assert station.tell("start") == "every mission of the plan flies already"
    station.comes_to("over")
    assert station.statuses() == {"Mission 1": "COMPLETED"}
    assert station.tell("start", missions=[keys["Mission 2"]]) == "1 mission started"
    station.comes_to("over")
    assert station.statuses() == {"Mission 2": "COMPLETED"}
    assert station.tell("start") == "3 missions started"


def test_of_what_was_put_away_the_next_start_leaves_out_what_was_completed(serve: Serve) -> None:
    station = serve()
    station.tell("start")
    station.until(lambda: "COMPLETED" in station.statuses().values(), "one is completed")
    station.tell("stop", how="land")
    station.comes_to("stopped")
    done = [name for name, status in station.statuses().items() if status == "COMPLETED"]
    station.tell("discard")
    assert [name for name, end in station.ends().items() if end == "COMPLETED"] == done
    assert set(station.ends().values()) == {"COMPLETED", "BROKEN_OFF"}
    assert station.tell("start").startswith(f"{3 - len(done)} mission")
    station.until(lambda: station.statuses(), "they are there")
    assert not {*done} & {*station.statuses()}
    wrong = station.refused("start", missions=["Mission 1"])
    assert wrong.startswith('no mission of the plan has the key "Mission 1"')
    assert station.post("/api/start", {"id": "x", "missions": [1]})[0] == 400


def forecast(station: Flown, **given: object) -> tuple[int, Any]:
    revision = station.get("/api/plan")["revision"]
    return station.post(
        "/api/preflight", {"revision": revision, "missions": None, "runs": 1, **given}
    )


def test_a_start_is_forecast_and_rehearsed_and_what_is_missing_is_flown_again_alone(
    serve: Serve,
) -> None:
    """Also while other missions fly."""
    station = serve(speed=2.0)
    status, told = forecast(station)
    assert (status, told["runs"], told["problems"]) == (200, 1, [])
    assert [one["name"] for one in told["missions"]] == [*station.ends()]
    assert all(one["ready"] and one["battery"] == 1.0 for one in told["drones"])
    replay = station.get("/api/flights/replay", flight=told["rehearsal"])
    assert replay["seconds"] >= told["median"]
    assert {one["name"] for one in replay["frames"][0]["missions"]} == {*station.ends()}
    for wrong, status in (
        ({"revision": 1}, 409),
        ({"runs": 0}, 409),
        ({"only_failed": "yes"}, 400),
    ):
        assert forecast(station, **wrong)[0] == status

    station.tell("start", revision=told["revision"])
    station.until(lambda: station.mission("Mission 3")["done"] > 0, "a trip is done")
    [problem] = forecast(station)[1]["problems"]
    assert problem["text"] == "there is no mission to start: make one first"
    copied = station.missions[1]
    same = [{**one, "key": f"{one['key']}-again"} for one in copied["trips"]]
    more = {**copied, "key": f"{copied['key']}-more", "name": "More", "trips": same}
    station.plan([*station.missions, more])
    _, beside = forecast(station)
    assert [one["name"] for one in beside["missions"]] == ["More"]
    assert "that fly already are flown to their end" in beside["assumed"][0]["text"]
    station.tell("cancel", mission="Mission 3")
    station.comes_to("over")

    assert "no mission has failed" in station.refused("start", only_failed=True)
    key = station.keys()["Mission 3"]
    known = next(m for m in station.missions if m["key"] == key)["done"]
    _, again = forecast(station, missions=[key], only_failed=True)
    trips = 4 if len(known) == 1 else 4 - len(known)  # what was picked alone is picked again
    assert [one["trips"] for one in again["missions"]] == [trips]
    said = station.tell("start", missions=[key], only_failed=True)
    assert said == f"1 mission started with {trips} trip{'s' * (trips > 1)} still to do"
    station.comes_to("over")
    assert station.ends()["Mission 3"] == "COMPLETED"
    assert station.mission("Mission 3")["total"] == trips
