"""What missions and drones wait for is told once for each long wait, and so is each landing that nobody asked for."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.plan_check import LONG
from pluto_fleet.flight.waits import Waits
from pluto_fleet.jobs.reports import SILENCE, Down
from pluto_fleet.report.sentences import line_of
from pluto_fleet.shared.domain.errors import Failure
from pluto_fleet.shared.domain.model import AfterTrip
from pluto_fleet.shared.fleet.telemetry import resting
from pluto_fleet.shared.time.kernel import FLEET
from tests.kit import apps
from tests.kit.living import Living
from tests.waits import fly

APP = apps.loaded(
    """pluto 1
app NAME {
  category scout(flight_time: 100 s, charge_time: 400 s) can take_photo, look
  action look
  create = MissionCreator
  wait = Clock
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager
  start -> create -> wait -> allocate -> launch -> watch
  [watch, retry] -> wait when STANDBY
  watch -> retry when FAILED
  [watch, retry] -> end otherwise
}""",
    "async def look(drone, trip, context): await context.sleep(25)\n",
).app


def watched(
    *missions: Any,
    homes: int = 1,
    after: AfterTrip = AfterTrip.HOME,
    silence: float = SILENCE,
    of: App = APP,
) -> Living:
    """Return a flight whose waits are watched, as in real flights."""
    places = [(0.5 + x, 0.5, 0.0) for x in range(homes)]
    fleet = replace(apps.fleet(*places, after=after), silence=silence)
    living = Living(of, *missions, on=fleet)
    living.kernel.spawn(Waits(living.life).watch(), FLEET, "what waits")
    return living


def mission(name: str, *xs: float, delay: float | None = None, **more: Any) -> Any:
    """Return a mission with a trip to each of these places."""
    trips: list[Any] = [
        APP.trip(
            name=f"{i}", action=more.pop("action", "take_photo"), target=(x, 0.5, 1.2), index=i
        )
        for i, x in enumerate(xs, 1)
    ]
    trips[0].delay = delay
    return APP.mission(name=name, trips=trips, **more)


def told(living: Living) -> list[str]:
    """Return the lines of waits and landings."""
    kinds = ("mission.waits", "drone.waits", "drone.landed")
    return [str(line_of(one)).strip() for one in living.events if one["event"] in kinds]


def test_each_mission_says_for_what_it_waits_and_until_when() -> None:
    """What is known to take long is told at once, anything else after ten seconds, and each once."""
    living = watched(
        mission("now", 4.0, 8.0, 8.0),
        mission("soon", 4.0, delay=9.0),
        mission("late", 4.0, delay=60.0),
        mission("queued", 4.0, promises={"after": ["now"]}),
        mission("window", 4.0, promises={"opens": 64_800.0}),
    )
    assert living.run() == ["COMPLETED"] * 5
    lines = told(living)
    assert lines[:5] == [
        "1.0 s  window: waits for its window, until 18:00 (17 h 59 min more)",
        "1.0 s  late: waits for the time of trip 1, until 00:01 (59 s more)",
        "11.0 s  queued: waits for now, after which it comes",
        "19.0 s  soon: waits for a drone (1 coming home)",
        "22.0 s  now: waits for a drone (1 coming home)",
    ]
    low = "too little for what waits"
    assert any(low in line and "  cf1 stands in its dock: " in line for line in lines)
    said = [line.partition("  ")[2] for line in lines if "window" in line or "queued" in line]
    assert len(said) == len({*said}) == 3


def test_missions_that_wait_for_the_same_are_told_in_one_line() -> None:
    living = watched(*(mission(f"m{i}", 4.0) for i in range(60)))
    living.run()
    first = told(living)[0]
    assert first.startswith("11.0 s  m0, m1, m2, ")
    assert first.endswith(", m49 and 9 more: waits for a drone (1 flying)")


def test_a_drone_that_lands_somewhere_and_waits_there_says_so() -> None:
    """Also when all missions are over; where it is lost its reason says that already."""
    living = watched(mission("a", 6.0), mission("b", 4.0), homes=2)
    living.at(5.0, lambda: living.navigation.strike("cf2", Failure.CRASH))
    living.at(16.0, lambda: living.navigation.strike("cf1", Failure.BATTERY))
    living.run()
    lines = [line for line in told(living) if "cf1" in line]
    assert lines[0].startswith("16.0 s  cf1 has landed at (")
    assert lines[0].endswith("), where nobody asked it to")
    assert "  cf1 stands at (" in lines[1]
    assert "and waits to be brought home" in lines[1]
    assert not [line for line in told(living) if "cf2 has landed" in line]


def test_who_has_flown_between_two_looks_waits_anew() -> None:
    """A drone may lose its link as soon as it is launched."""
    missions = [("a", 9.3), ("b", 15.3)]
    flown = watched(*(mission(*one) for one in missions))
    flown.run()
    then = flown.times("trip.launched")[-1] + 0.01
    living = watched(*(mission(*one) for one in missions))
    living.at(then, lambda: living.navigation.strike("cf1", Failure.LINK))
    living.run()
    lines = [line for line in told(living) if "  b: waits for a drone" in line]
    assert len(lines) == 2


def test_a_drone_that_stands_and_has_lost_its_place_waits_where_it_has_landed() -> None:
    """Where it believes to be drifts away, and it does not."""
    living = watched(mission("a", 6.0))
    body = living.navigation.bodies["cf1"]
    living.at(16.0, lambda: living.navigation.strike("cf1", Failure.BATTERY))
    for after in range(20, 60):
        here, then = (float(after), 0.5, 0.0), float(after)
        living.at(then, partial(body.turn, [resting(here, then)], then))
    living.kernel.run(living.kernel.spawn(living.kernel.sleep(40.0), FLEET, "time passes"))
    landed, waits = [line for line in told(living) if "cf1" in line]
    assert landed.split(" at ")[1].split(",")[:2] == waits.split(" at ")[1].split(" and")[0].split(
        ","
    )


def test_a_drone_that_landed_as_it_was_told_to_is_not_told_of_though_it_is_to_fly_already() -> None:
    """It may have its next trip by the time it is looked at."""
    living = watched(mission("a", 4.0), mission("b", 5.0, delay=30.0), after=AfterTrip.STAY)
    living.at(16.0, lambda: living.life.told_to.update(cf1="fly"))
    assert living.run() == ["COMPLETED"] * 2
    assert not [line for line in told(living) if "nobody asked" in line]


def test_after_a_stop_nothing_waits_as_all_come_home() -> None:
    """Its brain is told no more where they are."""
    living = watched(mission("a", 18.0))
    living.at(30.0, lambda: living.life.control.stop(Down.HOME))
    living.kernel.run(living.kernel.spawn(living.kernel.sleep(45.0), FLEET, "time passes"))
    assert not living.life.control.stopped.is_set
    assert told(living) == []


def test_a_drone_that_does_a_long_action_does_not_wait() -> None:
    living = watched(mission("a", 6.0, action="look"))
    assert living.run() == ["COMPLETED"]
    assert living.kernel.now > 3 * LONG
    assert told(living) == []


@pytest.mark.parametrize(("silence", "is_told"), [(4.0, True), (6.0, False)])
def test_a_drone_is_not_heard_after_the_silence_that_its_fleet_allows(
    monkeypatch: pytest.MonkeyPatch, silence: float, is_told: bool
) -> None:
    living = watched(mission("a", 6.0, action="look"), silence=silence)
    telemetry = type(living.life.link.telemetry("cf1"))
    monkeypatch.setattr(telemetry, "silence", 5.0, raising=False)
    living.run()
    assert any("is not heard" in line for line in told(living)) == is_told


def test_a_drone_that_flies_so_slowly_that_it_seems_to_stay_does_not_wait() -> None:
    """As one does that begins and ends a long leg gently."""
    slow = replace(APP.categories[0], speed=0.02, flight_time=3_600.0)
    living = watched(mission("a", 1.5), of=replace(APP, categories=(slow,)))
    assert living.run() == ["COMPLETED"]
    assert living.kernel.now > 8 * LONG
    assert told(living) == []


@pytest.mark.process
@pytest.mark.long
def test_no_wait_of_real_processes_goes_unsaid() -> None:
    assert fly(0, load=0, crtp=False).wrong == []
