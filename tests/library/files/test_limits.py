"""The smallest and the largest of each number in a plan are accepted, and what is accepted flies.

What is said of numbers beyond is in `sentences/fleets_beyond.txt` and `missions_beyond.txt`.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from pluto_fleet.app import App
from pluto_fleet.files.fleet import BETWEEN, FleetFile, load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.plan_check import problems
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.shared.domain.values import HEIGHT, MASS, PLACE, RADIUS, SIDE, TIME, Quantity
from pluto_fleet.trials.case import Case, Strike, StrikeKind, Weather
from pluto_fleet.trials.lives import TrialRun
from tests.trials.examples import app_of

DRONE = '[[drone]]\nid = "a"\ncategory = "scout"\nhome = [1, 1]\n'
SOURCE = f'{DRONE}[[world.source]]\nquantity = "pm10"\npeak = 3\n'
TRIP = '[[mission]]\nname = "m"\n[[mission.trip]]\naction = "measure"\ntarget = [1, 1]\n'

TURNS = 4000
"""Of a run's clock: more show nothing new, and a plan may well last for years."""


LONGEST = 100_000.0
"""Seconds of the delays that are flown: nothing of longer ones differs, and a trial is a week at most."""

CATEGORIES = (
    "",
    "(speed: 0.01 m/s, flight_time: 1000000 s)",
    "(speed: 100 m/s, flight_time: 1000000 s, charge_time: 1 s)",
    "(speed: 100 m/s, flight_time: 30 s, charge_time: 1000000 s, reserve: 0 %)",
    "(payload: 1000 kg, speed: 5 m/s, flight_time: 1000000 s, reserve: 99 %)",
)


@lru_cache
def extreme_app(number: int) -> App:
    """Return an app that has all there is to ask for, with drones of one of these categories."""
    return app_of(f"""
        pluto 1
        app extreme {{
          category scout{CATEGORIES[number]} can take_photo, measure
          category carrier{CATEGORIES[number]} can pick_item, release_item
          create = MissionCreator
          wait = Clock
          allocate = DroneAllocator
          launch = TripLauncher
          watch = TripMonitor
          timer = TimerMonitor
          gap = GapMonitor
          first = GateFIFO
          again = MissionRepeater
          retry = PriorityManager
          start -> create -> wait -> allocate -> launch -> [watch, timer, gap] -> first
          first -> wait when STANDBY
          first -> retry when FAILED
          first -> again when COMPLETED
          retry -> allocate when STANDBY
          again -> wait when STANDBY
          again -> end when COMPLETED
          retry -> end otherwise
        }}
        """)


def load(
    folder: Path, fleet: str, missions: str, number: int = 0
) -> tuple[FleetFile, list[Mission[Any]]]:
    """Read both files of a plan."""
    (folder / "f.toml").write_text(fleet, encoding="utf-8")
    (folder / "m.toml").write_text(missions, encoding="utf-8")
    app = extreme_app(number)
    found = load_fleet(folder / "f.toml", app)
    return found, load_missions(folder / "m.toml", app, found.airspace)


@pytest.mark.parametrize(
    "fleet",
    [
        f"{SOURCE}at = [1, 1]\nradius = {RADIUS.least}\n",
        f"{SOURCE}at = [1, 1]\nradius = {RADIUS.most}\n",
        f"[map]\nsize = [{SIDE.most}, {SIDE.most}]\n{DRONE}",
        f"[fleet]\napart = {BETWEEN.least}\n{DRONE}",
        f"[fleet]\napart = 0\n{DRONE}",
    ],
)
def test_the_ends_are_accepted(tmp_path: Path, fleet: str) -> None:
    """Both of them, and 0 where that says that there is none."""
    load(tmp_path, fleet, TRIP)


class Drawn:
    """The two files of a plan, of ordinary numbers and of the ends of what numbers may be."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.side, cruise = self.end(SIDE, 5.0, 20.0), self.end(HEIGHT, 1.2)
        self.mass = self.end(MASS, 0.001)
        drones = "".join(
            f'[[drone]]\nid = "{kind}"\ncategory = "{kind}"\nhome = {self.spot()}\n'
            for kind in rng.choice((["scout"], ["scout", "carrier"]))
        )
        self.fleet = f"""
            [map]
            size = [{self.side!r}, {self.side!r}]
            cruise_height = {cruise!r}
            ceiling = {max(cruise, self.end(HEIGHT, 3.0))!r}
            [fleet]
            after_trip = "{rng.choice(("home", "stay", "next"))}"
            apart = {self.end(BETWEEN, 0.0, 0.5)!r}
            max_airborne = {rng.choice((1, 10**9))}
            {drones}
            [world]
            background = {{ temperature = {rng.choice((20.0, 1e9, -1e9))!r} }}
            [[world.source]]
            quantity = "temperature"
            at = [{self.end(PLACE, 1.0)!r}, 1.0]
            peak = {rng.choice((5.0, 1e9, -1e9))!r}
            radius = {self.end(RADIUS, 1.0)!r}
            """
        actions = rng.choice(
            (("measure",), ("take_photo", "measure"), ("pick_item", "release_item"))
        )
        self.missions = f"""
            [[mission]]
            repeat = {rng.choice((0, 2))}
            every = {self.time()!r}
            safe_time = {self.time()!r}
            {"".join(map(self.trip, actions))}
            """

    def end(self, limit: Quantity, *plain: float) -> float:
        """Draw an ordinary number as often as one of the ends."""
        return self.rng.choice((self.rng.choice(plain), self.rng.choice((limit.least, limit.most))))

    def time(self) -> float:
        return min(LONGEST, self.end(TIME, 0.0, 10.0, 60.0))

    def spot(self) -> str:
        """Draw a place, at the edges of the map now and then."""
        x, y = (self.side * self.rng.choice((0.0, 1.0, 0.5, 0.4)) for _ in "xy")
        return repr([x, y])

    def trip(self, action: str) -> str:
        item = f'item = {{ name = "x", mass = {self.mass!r} }}' if "item" in action else ""
        return f"""
            [[mission.trip]]
            action = "{action}"
            target = {self.spot()}
            {item}
            delay = {self.time()!r}
            gap = {self.time()!r}
            priority = {self.rng.choice((0, 10**9, -(10**9)))}
            """


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(number=st.integers(0, len(CATEGORIES) - 1), seed=st.integers(0, 10**6))
def test_what_is_accepted_flies(tmp_path: Path, number: int, seed: int) -> None:
    """In the simulated world, with all that goes wrong there, and under any Stop: nothing is raised."""
    rng, app = Random(seed), extreme_app(number)
    drawn = Drawn(rng)
    try:
        fleet, missions = load(tmp_path, drawn.fleet, drawn.missions, number)
    except BadInput:
        return  # two drones stand at one place, say
    if problems(missions, app, fleet, fleet.airspace):
        return
    kind = rng.choice((StrikeKind.RTL, StrikeKind.LAND, StrikeKind.CRASH, StrikeKind.GATEWAY))
    strikes = (Strike(kind=kind, row=rng.choice((1, 3, 6)), after=rng.choice((0.0, 3.0))),)
    weather = Weather(crash=0.1, link=0.1, battery=0.1)
    case = Case(seed=seed, missions=tuple(missions), fleet=fleet, weather=weather, strikes=strikes)
    run = TrialRun(app, case)
    run.start_life()
    for _ in range(TURNS):
        if run.over or not run.turn():
            break
    trial = run.record.closed(run.lives)
    for brain in run.brains:
        brain.die()
    run.world.close()
    assert [said for said in run.found if not said.startswith("it goes on for ever")] == []
    assert not any("Error" in said for said in trial.wrong)
