"""A Start as a page makes it: forecast, rehearsed, flown, and what is missing flown again."""

from __future__ import annotations

from typing import Any

from tests.kit.station import Station, until
from tests.library.station.flights.conftest import Serve
from tests.library.station.flights.test_again import ends, key_of
from tests.library.station.flights.test_flights import comes_to, refused, row, tell


def forecast(station: Station, **given: object) -> tuple[int, Any]:
    revision = station.get("/api/plan")["revision"]
    asked = {"revision": revision, "missions": None, "runs": 3, **given}
    return station.post("/api/preflight", asked)


def done(station: Station, mission: str) -> int:
    """Return how many trips a mission has done that flies."""
    return sum(one["done"] for one in station.now()["missions"] if one["name"] == mission)


def test_a_start_is_forecast_and_rehearsed_and_what_is_missing_is_flown_again_alone(
    serve: Serve,
) -> None:
    """Also while other missions fly."""
    station = serve("drugs_distribution", "--speed", "15")  # it flies while it is forecast
    status, told = forecast(station)
    assert (status, told["runs"], told["problems"]) == (200, 3, [])
    assert [one["name"] for one in told["missions"]] == ["Mission 1", "Mission 2", "Mission 3"]
    assert all(one["ready"] and one["battery"] == 1.0 for one in told["drones"])
    replay = station.get(f"/api/flights/replay?flight={told['rehearsal']}")
    assert replay["seconds"] >= told["median"]
    assert {one["name"] for one in replay["frames"][0]["missions"]} == {*ends(station)}
    assert forecast(station, revision=1)[0] == 409
    assert forecast(station, runs=0)[0] == 409
    assert forecast(station, only_failed="yes")[0] == 400

    tell(station, "start", revision=told["revision"])
    comes_to(station, "flying")
    until(lambda: done(station, "Mission 3") > 0, "a trip is done")
    _, none = forecast(station)
    assert [one["text"] for one in none["problems"]] == [
        "there is no mission to start: make one first"
    ]
    plan = station.get("/api/plan")
    copied = plan["missions"][1]
    same = [{**one, "key": f"{one['key']}-again"} for one in copied["trips"]]
    more = {**copied, "key": f"{copied['key']}-more", "name": "More", "trips": same}
    given = {"revision": plan["revision"], "missions": [*plan["missions"], more]}
    assert station.put("/api/plan", given)[0] == 200
    _, beside = forecast(station)
    assert [one["name"] for one in beside["missions"]] == ["More"]
    assert "that fly already are flown to their end" in beside["assumed"][0]["text"]
    tell(station, "cancel", mission="Mission 3")
    comes_to(station, "over")

    assert "no mission has failed" in refused(station, "start", only_failed=True)[1]
    key = key_of(station, "Mission 3")
    known = next(m for m in station.get("/api/plan")["missions"] if m["key"] == key)["done"]
    _, again = forecast(station, missions=[key], only_failed=True)
    trips = 4 if len(known) == 1 else 4 - len(known)  # what was picked alone is picked again
    assert [one["trips"] for one in again["missions"]] == [trips]
    said = tell(station, "start", missions=[key], only_failed=True)
    assert said == f"1 mission started with {trips} trip{'s' * (trips > 1)} still to do"
    comes_to(station, "over")
    assert ends(station)["Mission 3"] == "COMPLETED"
    assert row(station, "Mission 3")["total"] == trips
