"""What trials have found: each case as small as it was made, and nothing of it is wrong any more."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.drones import DroneEntry
from pluto_fleet.files.fleet import FleetFile, default_fleet
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import AfterTrip, Item, Mission, Point
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.trials.case import Case, Strike, StrikeKind, Weather
from pluto_fleet.trials.lives import tried
from tests.trials.examples import app_of

CARRIER = app_of("""
    pluto 1
    app carrier {
      category carrier(payload: 5 g, speed: 0.5 m/s) can pick_item, release_item
      create = MissionCreator
      allocate = DroneAllocator
      launch = TripLauncher
      watch = TripMonitor
      limit = TimerMonitor(default: 30 s)
      first = GateFIFO
      start -> create -> allocate -> launch -> [watch, limit] -> first
      first -> allocate when STANDBY
      first -> end
    }
    """)
FLEET = FleetFile(
    airspace=Airspace(size=(20.0, 20.0)),
    drones=(DroneEntry(id="d1", category="carrier", home=(1.0, 1.0, 0.0)),),
)

RELEASE_IS_LAUNCHED, FIRST_IS_COMPLETED = 2, 3
"""In which rows of the journals."""


def carried(weather: Weather, *strikes: Strike) -> Case:
    """A mission that picks an item nearby and is to release it too far away for its limit of 30 s."""
    trips = [
        CARRIER.trip(
            name=name,
            index=number,
            action=action,
            target=target,
            item=Item(name="pill", mass=0.001),
        )
        for number, (name, action, target) in enumerate(
            (
                ("pick", "pick_item", (2.0, 1.0, 1.2)),
                ("release", "release_item", (18.0, 18.0, 1.2)),
            )
        )
    ]
    mission = CARRIER.mission(name="m1", index=0, trips=trips)
    return Case(seed=1, missions=(mission,), fleet=FLEET, weather=weather, strikes=strikes)


@pytest.mark.parametrize("after", [29.0, 29.8, 30.0, 30.2, 30.4, 31.0])
def test_a_trip_that_is_called_off_and_fails_meanwhile_fails_once(after: float) -> None:
    """Its limit is over, its drone is asked what it has done, and falls before it has answered."""
    fall = Strike(kind=StrikeKind.FALL, row=RELEASE_IS_LAUNCHED, after=after)
    trial = tried(CARRIER, carried(Weather(slow=0.4, radio=0.5), fall))
    assert trial.fired[StrikeKind.FALL.value] == 1
    assert trial.wrong == ()
    assert trial.ends == {"m1": "FAILED"}


def test_one_function_for_two_actions_is_no_deed_done_twice() -> None:
    """What was done is what the trip says, and not every action that the function stands for."""
    app = duster()
    trip = app.trip(name="1", index=0, action="dust", target=(3.0, 3.0, 1.2))
    mission = app.mission(name="m1", index=0, trips=[trip])
    trial = tried(app, Case(seed=1, missions=(mission,), fleet=default_fleet(app)))
    assert [act.action for act in trial.acts] == ["dust"]
    assert trial.wrong == ()


def duster() -> App:
    """Return an app whose two actions are one function."""

    async def work(drone: object, trip: object, context: Context) -> None:
        await context.sleep(2.0)

    return app_of(
        """
        pluto 1
        app duster {
          action spray
          action dust
          category duster can spray, dust
          create = MissionCreator
          allocate = DroneAllocator
          launch = TripLauncher
          watch = TripMonitor
          start -> create -> allocate -> launch -> watch -> end
          watch -> allocate when STANDBY
        }
        """,
        {"spray": work, "dust": work},
    )


@pytest.mark.parametrize("after", [4.6, 4.8, 5.0])
@pytest.mark.parametrize("seed", [0, 1])
def test_what_a_dead_app_commanded_keeps_no_place_in_the_air(seed: int, after: float) -> None:
    """It and its gateway lose one another as a drone touches down; only one may fly at once."""
    app = duster()
    missions = tuple(
        app.mission(
            name=name,
            index=place,
            trips=[
                app.trip(name=str(x), index=x, action="dust", target=(3.0 + x, 3.0, 1.2))
                for x in range(2)
            ],
        )
        for place, name in enumerate(("m1", "m2"))
    )
    fleet = replace(default_fleet(app, 2), after_trip=AfterTrip.STAY, max_airborne=1)
    cut = Strike(kind=StrikeKind.CUT, row=FIRST_IS_COMPLETED, after=after)
    case = Case(
        seed=seed, missions=missions, fleet=fleet, weather=Weather(radio=0.5), strikes=(cut,)
    )
    trial = tried(app, case)
    assert trial.fired[StrikeKind.CUT.value] == 1
    assert trial.wrong == ()


def sprayer() -> App:
    """Return an app with a limit on its trips, whose missions try again."""

    async def spray(drone: object, trip: object, context: Context) -> None:
        await context.sleep(2.0)

    return app_of(
        """
        pluto 1
        app sprayer {
          action spray
          category sprayer can spray
          category watcher can measure
          create = MissionCreator
          allocate = DroneAllocator(policy: first)
          launch = TripLauncher
          watch = TripMonitor
          limit = TimerMonitor
          first = GateFIFO
          retry = PriorityManager
          start -> create -> allocate -> launch -> [watch, limit] -> first
          first -> allocate when STANDBY
          first -> retry when FAILED
          retry -> allocate when STANDBY
          retry -> end otherwise
          first -> end when COMPLETED
        }
        """,
        {"spray": spray},
    )


SPRAYER = sprayer()
MIXED = replace(
    FLEET,
    drones=(
        DroneEntry(id="s1", category="watcher", home=(0.5, 0.5, 0.0)),
        DroneEntry(id="s2", category="sprayer", home=(1.1, 0.5, 0.0)),
    ),
)
NEIGHBOURS = replace(
    FLEET,
    drones=tuple(
        DroneEntry(id=f"d{x}", category="sprayer", home=(0.5 + 0.6 * x, 0.5, 0.0)) for x in range(2)
    ),
)


def sprayed(name: str, place: int, target: Point, **fields: Any) -> Mission[Any]:
    """Return a mission of one trip."""
    trip = SPRAYER.trip(name="1", index=0, action="spray", target=target)
    return SPRAYER.mission(name=name, index=place, trips=[trip], **fields)


def test_a_drone_that_waits_to_take_off_is_brought_home_by_the_next_app() -> None:
    """It stands when it is asked, and has its way before it hears that its flight is off.

    Another loses its link above its home as it climbs, and so gets out of its way.
    """
    measured = SPRAYER.trip(name="1", index=0, action="measure", target=(2.9, 2.7, 1.2))
    missions = (
        SPRAYER.mission(name="m1", index=0, trips=[measured]),
        sprayed("m2", 1, (1.5, 17.8, 1.2), safe_time=2.0),
    )
    death = Strike(kind=StrikeKind.LOST, row=1, after=2.2)
    weather = Weather(slow=0.4, link=0.3)
    case = Case(seed=189003, missions=missions, fleet=MIXED, weather=weather, strikes=(death,))
    trial = tried(SPRAYER, case)
    assert trial.fired["flight: link"] == 1
    assert trial.lives == 2
    assert trial.wrong == ()


@pytest.mark.parametrize("after", [10.6, 10.8, 11.0, 11.2])
def test_no_action_begins_after_its_mission_was_paused(after: float) -> None:
    """The drone arrives while it is asked how far it is; and then it is brought home."""
    missions = (sprayed("m1", 0, (2.9, 2.7, 1.2)),)
    fair = Case(seed=1, missions=missions, fleet=NEIGHBOURS, weather=Weather(slow=0.4))
    trial = tried(
        SPRAYER, replace(fair, strikes=(Strike(kind=StrikeKind.PAUSE, row=1, after=after),))
    )
    assert trial.wrong == ()
    events = [event["event"] for event in trial.events]
    assert events.index("mission.paused") < events.index("action.begun")
    assert "mission.uncertain" not in events
    assert trial.ends == {"m1": "COMPLETED"}


def test_a_mission_that_is_cancelled_while_its_drone_is_asked_ends_after_its_flight() -> None:
    """It has been paused a moment before, and the line is slow."""
    missions = (sprayed("m1", 0, (2.9, 2.7, 1.2)),)
    pause = Strike(kind=StrikeKind.PAUSE, row=1, after=5.0)
    cancel = Strike(kind=StrikeKind.CANCEL, row=1, after=5.4)
    fair = Case(seed=1, missions=missions, fleet=NEIGHBOURS, weather=Weather(slow=0.4))
    trial = tried(SPRAYER, replace(fair, strikes=(pause, cancel)))
    assert trial.wrong == ()
    assert trial.ends == {"m1": "CANCELLED"}
    events = [event["event"] for event in trial.events]
    assert events.index("trip.failed") < events.index("mission.ended")
