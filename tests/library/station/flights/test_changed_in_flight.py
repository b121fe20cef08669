"""What has not flown is changed on a page while it is under way; drones join; mishaps are rehearsed."""

from __future__ import annotations

from typing import Any

from tests.library.station.conftest import Serve
from tests.library.station.in_process import Flown

FIRST = "Mission 1"


def slow(serve: Serve) -> Flown:
    """Let the whole plan fly, and not be over soon."""
    return serve(speed=3.0).flying()


def drawn(station: Flown) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the plan as a page sends it, and a mission in it."""
    plan = station.get("/api/plan")
    data = {key: plan[key] for key in ("revision", "missions")}
    return data, next(one for one in plan["missions"] if one["name"] == FIRST)


def test_a_page_that_saves_its_plan_changes_what_has_not_flown(serve: Serve) -> None:
    """In another order, moved, added and taken out; flight and plan agree, over a death, to the end."""
    station = slow(serve)
    plan, mission = drawn(station)
    a, _, c = mission["trips"]
    new = {"key": "a-new-trip", "action": "take_photo", "target": [15.0, 8.0]}
    mission["trips"] = [a, {**c, "target": [14.0, 8.5]}, new]
    status, answer = station.put("/api/plan", plan)
    assert status == 200, answer
    assert station.put("/api/plan", plan) == (200, answer)  # an answer may be lost
    assert [one["key"] for one in drawn(station)[1]["trips"]] == [a["key"], c["key"], new["key"]]
    assert len(station.events("mission.replanned")) == 1
    station.kill()
    station.start()
    station.tell("resume")
    station.comes_to("over")
    flown = [one["trip"] for one in station.events("trip.completed") if one["mission"] == FIRST]
    assert flown == ["A", "C", "1"]
    targets = [one["target"] for one in drawn(station)[1]["trips"]]
    assert targets == [a["target"], [14.0, 8.5], [15.0, 8.0]]


def test_the_same_can_be_commanded_once(serve: Serve) -> None:
    """With what is to be flown from now on, and what that was before."""
    station = slow(serve)
    b, c = drawn(station)[1]["trips"][1:]
    trips = [{**c, "target": [14.0, 8.5]}, b]
    replaces = {"mission": FIRST, "replaces": ["B", "C"]}
    asked: dict[str, object] = {"id": "the-same", "trips": trips, **replaces}
    first, again = (station.post("/api/change-trips", asked) for _ in range(2))
    assert first == again == (200, {"said": '"Mission 1": what has not flown is changed'})
    assert [one["name"] for one in drawn(station)[1]["trips"]] == ["A", "C", "B"]
    said = station.refused("change-trips", trips=[], **replaces)
    assert said == 'mission "Mission 1": it was changed: look at it again'
    outside = station.refused("change-trips", mission=FIRST, trips=[{**c, "target": [99.0, 8.5]}])
    assert "[99.0, 8.5] is outside" in outside
    assert len(station.events("mission.replanned")) == 1
    station.refused("change-trips", mission="X", trips=[])
    station.tell("stop", how="land")
    station.comes_to("stopped")
    said = station.refused("change-trips", mission=FIRST, trips=[])
    assert "resume the flight first" in said


def test_a_drone_joins_and_stays(serve: Serve) -> None:
    """In the fleet that the pages show, in the journal that is resumed, and in the next flight."""
    station = slow(serve)
    drones = station.get("/api/app")["drones"]
    category = drones[0]["category"]
    cf9 = {"drone": "cf9", "category": category, "home": [10.0, 4.0]}
    assert station.tell("join", **cf9) == "cf9 joins the fleet"
    fleet = len(drones) + 1
    station.until(lambda: station.now()["state"]["fleet"] == fleet, "the pages are told")
    shown = {"id": "cf9", "category": category, "home": [10.0, 4.0, 0.0]}
    assert station.get("/api/app")["drones"][-1] == shown
    station.until(lambda: station.drone("cf9")["status"] != "OFFLINE", "it is asked how it is")
    assert 'drone "cf9": there is another' in station.refused("join", **cf9)
    crowd = station.refused("join", **{**cf9, "drone": "cf10"})
    assert 'home is where drone "cf9" has its own' in crowd
    station.kill()
    station.start()
    assert station.get("/api/app")["drones"][-1] == shown
    station.tell("resume")
    station.until(lambda: not station.now()["state"]["busy"], "it goes on")
    station.tell("cancel", mission=None)
    station.comes_to("over")
    assert station.drone("cf9")["status"] in ("FREE", "LANDED", "CHARGING")
    asked = {"revision": station.get("/api/plan")["revision"], "missions": None, "runs": 1}
    _, told = station.post("/api/preflight", asked)
    assert [one["id"] for one in told["drones"]] == [one["id"] for one in drones] + ["cf9"]
    station.tell("start")
    station.until(lambda: station.now()["missions"], "it flies again")
    assert station.drone("cf9")["id"] == "cf9"


def test_a_crash_and_a_question_are_rehearsed(serve: Serve) -> None:
    station = slow(serve)
    station.until(lambda: station.mission("Mission 3")["drone"], "Mission 3 has a drone")
    carrier = station.mission("Mission 3")["drone"]
    assert station.tell("mishap", drone=carrier, kind="uncertain").startswith(carrier)
    station.until(lambda: station.mission("Mission 3")["status"] == "UNCERTAIN", "it is asked")
    said = station.mission("Mission 3")["question"]["said"]
    assert said["facts"] == {"action": "pick_item", "trip": "A", "drone": carrier}
    assert said["text"].startswith("was pick_item of trip A done")
    station.tell("decide", mission="Mission 3", answer="done")

    def high() -> set[str]:
        """The other drones that fly, and do not land at once."""
        return {one["id"] for one in station.now()["drones"] if (one["z"] or 0.0) > 0.8} - {carrier}

    station.until(high, "another drone flies")
    other = min(high())
    assert station.tell("mishap", drone=other, kind="crash") == f"{other}: crash"
    station.until(lambda: station.drone(other)["status"] == "LOST", "it is lost")
    wrong: dict[str, object] = {"id": "x", "drone": other, "kind": "rain"}
    assert station.post("/api/mishap", wrong)[0] == 400
    kinds = [one["kind"] for one in station.events("drone.mishap")]
    assert kinds == ["uncertain", "crash"]
