"""What has not flown is changed on a page while it is under way; drones join; mishaps are rehearsed."""

from __future__ import annotations

from typing import Any

from tests.kit.station import Station, until
from tests.library.station.flights.conftest import Serve
from tests.library.station.flights.test_flights import (
    comes_to,
    events,
    flying,
    refused,
    row,
    tell,
)

SLOW = ("--speed", "6")
FIRST = "Mission 1"


def drawn(station: Station, name: str = FIRST) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the plan as a page sends it, and a mission in it."""
    plan = station.get("/api/plan")
    data = {key: plan[key] for key in ("revision", "missions")}
    return data, next(one for one in plan["missions"] if one["name"] == name)


def flown(station: Station, name: str = FIRST) -> list[str]:
    done = [one for one in events(station, "trip.completed") if one["mission"] == name]
    return [str(one["trip"]) for one in done]


def test_a_page_that_saves_its_plan_changes_what_has_not_flown(serve: Serve) -> None:
    """In another order, moved, added and taken out; flight and plan agree, over a kill, to the end."""
    station = flying(serve("drugs_distribution", *SLOW))
    plan, mission = drawn(station)
    a, _, c = mission["trips"]
    new = {"key": "a-new-trip", "action": "take_photo", "target": [15.0, 8.0]}
    mission["trips"] = [a, {**c, "target": [14.0, 8.5]}, new]
    status, answer = station.put("/api/plan", plan)
    assert status == 200, answer
    again = station.put("/api/plan", plan)  # an answer may be lost
    assert again == (200, answer)
    now = next(one for one in answer["missions"] if one["name"] == FIRST)
    assert [one["key"] for one in now["trips"]] == [a["key"], c["key"], new["key"]]
    assert len(events(station, "mission.replanned")) == 1
    for other in ("Mission 2", "Mission 3"):
        tell(station, "cancel", mission=other)
    station.kill()
    station.start()
    tell(station, "resume")
    until(lambda: flown(station)[-1:] == ["C"], "the trip that was moved is flown")
    assert [one["name"] for one in row(station, FIRST)["trips"]] == ["A", "C", "1"]
    _, mission = drawn(station)
    assert [one["target"] for one in mission["trips"]] == [a["target"], [14.0, 8.5], [15.0, 8.0]]


def test_what_has_taken_off_cannot_be_changed_and_the_plan_stays(serve: Serve) -> None:
    """Nor what cannot be flown; and an old plan is an old plan."""
    station = flying(serve("drugs_distribution", *SLOW))
    plan, mission = drawn(station)
    trips = mission["trips"]
    for wrong, why in (
        ([{**trips[0], "target": [4.0, 8.5]}, *trips[1:]], 'trip "A" has taken off meanwhile'),
        (trips[1:], 'trip "A" has taken off meanwhile'),
        (
            [*trips[:2], {**trips[2], "target": [99.0, 8.5]}],
            'trip "C": target (99, 8.5) is outside',
        ),
    ):
        mission["trips"] = wrong
        status, answer = station.put("/api/plan", plan)
        assert status == 400
        assert why in answer["said"]
    mission["trips"] = trips[:1]
    status, _ = station.put("/api/plan", {**plan, "revision": plan["revision"] - 1})
    assert status == 409
    assert events(station, "mission.replanned") == []
    assert drawn(station)[1]["trips"] == trips


def test_the_same_can_be_commanded_once(serve: Serve) -> None:
    """With what is to be flown from now on, and what that was before."""
    station = flying(serve("drugs_distribution", *SLOW))
    _, mission = drawn(station)
    b, c = mission["trips"][1:]
    trips = [{**c, "target": [14.0, 8.5]}, b]
    asked: dict[str, object] = {
        "id": "the-same",
        "mission": FIRST,
        "trips": trips,
        "replaces": ["B", "C"],
    }
    first, again = (station.post("/api/change-trips", asked) for _ in range(2))
    assert first == again == (200, {"said": '"Mission 1": what has not flown is changed'})
    assert [one["name"] for one in drawn(station)[1]["trips"]] == ["A", "C", "B"]
    said = refused(station, "change-trips", mission=FIRST, trips=[], replaces=["B", "C"])
    assert said == (409, 'mission "Mission 1": it was changed: look at it again')
    assert len(events(station, "mission.replanned")) == 1
    assert refused(station, "change-trips", mission="X", trips=[])[0] == 409
    tell(station, "stop", how="land")
    comes_to(station, "stopped")
    assert "resume the flight first" in refused(station, "change-trips", mission=FIRST, trips=[])[1]


def test_a_drone_joins_and_stays(serve: Serve) -> None:
    """In the fleet that the pages show, in the journal that is resumed, and in the next flight."""
    station = flying(serve("drugs_distribution", *SLOW))
    cf9 = {"drone": "cf9", "category": "scout", "home": [10.0, 4.0]}
    drones = station.get("/api/app")["drones"]
    category = drones[0]["category"]
    cf9["category"] = category
    assert tell(station, "join", **cf9) == "cf9 joins the fleet"
    until(lambda: station.now()["state"]["fleet"] == len(drones) + 1, "the pages are told")
    shown = {"id": "cf9", "category": category, "home": [10.0, 4.0, 0.0]}
    assert station.get("/api/app")["drones"][-1] == shown
    until(lambda: drone(station, "cf9")["status"] != "OFFLINE", "cf9 is asked how it is")
    assert 'drone "cf9": there is another' in refused(station, "join", **cf9)[1]
    crowd = refused(station, "join", **{**cf9, "drone": "cf10"})[1]
    assert 'home is where drone "cf9" has its own' in crowd
    station.kill()
    station.start()
    assert station.get("/api/app")["drones"][-1] == shown
    tell(station, "resume")
    until(lambda: station.phase == "flying" and not station.now()["state"]["busy"], "it goes on")
    tell(station, "cancel", mission=None)
    comes_to(station, "over")
    assert drone(station, "cf9")["status"] in ("FREE", "LANDED", "CHARGING")
    tell(station, "start")
    until(lambda: station.phase == "flying" and bool(station.now()["missions"]), "it flies again")
    assert drone(station, "cf9")["id"] == "cf9"


def drone(station: Station, id: str) -> dict[str, Any]:
    return next(one for one in station.now()["drones"] if one["id"] == id)


def high(station: Station) -> set[str]:
    """Return the drones that fly, and do not land at once."""
    return {one["id"] for one in station.now()["drones"] if (one["z"] or 0.0) > 0.8}


def test_a_crash_and_a_question_are_rehearsed(serve: Serve) -> None:
    station = flying(serve("drugs_distribution", *SLOW))
    until(lambda: bool(row(station, "Mission 3")["drone"]), "Mission 3 has a drone")
    carrier = row(station, "Mission 3")["drone"]
    assert tell(station, "mishap", drone=carrier, kind="uncertain").startswith(carrier)
    until(lambda: row(station, "Mission 3")["status"] == "UNCERTAIN", "it is asked")
    said = row(station, "Mission 3")["question"]["said"]
    assert said["facts"] == {"action": "pick_item", "trip": "A", "drone": carrier}
    assert said["text"].startswith("was pick_item of trip A done")
    tell(station, "decide", mission="Mission 3", answer="done")
    until(lambda: bool(high(station) - {carrier}), "another drone flies")
    other = min(high(station) - {carrier})
    assert tell(station, "mishap", drone=other, kind="crash") == f"{other}: crash"
    until(lambda: drone(station, other)["status"] == "LOST", "it is lost")
    assert refused(station, "mishap", drone=other, kind="rain")[0] == 400
    assert [one["kind"] for one in events(station, "drone.mishap")] == ["uncertain", "crash"]


def test_a_crazyflie_that_is_flown_as_a_real_one_joins(serve: Serve) -> None:
    """Simulated down to its radio: it is connected like any other; mishaps are not for it."""
    station = flying(serve("drugs_distribution", "--crtp-sim", "2"))
    category = station.get("/api/app")["drones"][0]["category"]
    why = refused(station, "mishap", drone="cf1", kind="crash")[1]
    assert why == "mishaps happen to drones that --sim simulates, and to no others"
    tell(station, "join", drone="cf9", category=category, home=[10.0, 4.0])
    joins = ("OFFLINE", "RECOVERING")
    until(lambda: drone(station, "cf9")["status"] not in joins, "cf9 is connected")
    assert drone(station, "cf9")["status"] in ("FREE", "BUSY")
    tell(station, "stop", how="land")
    comes_to(station, "stopped")
