"""Plans at random whose numbers are as small or as large as plan files may have them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import exp, log
from random import Random

from pluto_fleet.app import App
from pluto_fleet.files.fleet import BETWEEN
from pluto_fleet.shared.domain.values import HEIGHT, MASS, PLACE, RADIUS, SIDE, TIME, Quantity
from tests.trials.examples import app_of

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


class Extremes:
    """Draws the two files of a plan."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.side = (self.number(SIDE, (5.0, 20.0)), self.number(SIDE, (5.0, 20.0)))
        self.cruise = self.number(HEIGHT, (1.2, 0.8))
        self.ceiling = max(self.cruise, self.number(HEIGHT, (3.0, 10.0)))

    def number(self, limit: Quantity, plain: Sequence[float]) -> float:
        """Draw a number: an ordinary one, one of the ends, or any between."""
        way = self.rng.random()
        if way < 0.5:
            return self.rng.choice(plain)
        if way < 0.8:
            return self.rng.choice((limit.least, limit.most))
        least = max(limit.least, 1e-4)
        return round(exp(self.rng.uniform(log(least), log(limit.most))), 6) or limit.least

    def time(self) -> float:
        """Draw a time."""
        return min(LONGEST, self.number(TIME, (0.0, 1.0, 10.0, 60.0)))

    def spot(self) -> str:
        """Draw a place on the map, at its edges now and then."""
        x, y = (
            round(side * self.rng.choice((0.0, 1.0, 0.5, self.rng.random())), 6)
            for side in self.side
        )
        height = self.rng.choice((None, 0.0, self.cruise, self.ceiling))
        return repr([x, y] if height is None else [x, y, height])

    def fleet(self) -> str:
        """Return a fleet file."""
        rng, (width, depth) = self.rng, self.side
        lines = ["[map]", f"size = [{width!r}, {depth!r}]"]
        lines += [f"cruise_height = {self.cruise!r}", f"ceiling = {self.ceiling!r}"]
        if rng.random() < 0.3:
            corners = [
                [round(width * rng.random(), 6), round(depth * rng.random(), 6)] for _ in range(3)
            ]
            far = [PLACE.most, PLACE.least]
            lines.append(f"no_fly = [{[*corners, far] if rng.random() < 0.1 else corners!r}]")
        lines += ["[fleet]", f'after_trip = "{rng.choice(("home", "stay", "next"))}"']
        lines.append(f"apart = {self.number(BETWEEN, (0.0, 0.5, 1.0))!r}")
        if rng.random() < 0.3:
            lines.append(f"max_airborne = {rng.choice((1, 10**9))}")
        for place in range(rng.choice((1, 2, 3))):
            kind = ("scout", "carrier")[place % 2]
            x, y = (round(side * rng.random(), 6) for side in self.side)
            lines += ["[[drone]]", f'id = "d{place}"', f'category = "{kind}"', f"home = [{x}, {y}]"]
        lines += ["[world]", f"background = {{ temperature = {rng.choice((20.0, 1e9, -1e9))!r} }}"]
        for _ in range(rng.choice((0, 1, 3))):
            at = [self.number(PLACE, (1.0, 2.0)), rng.choice((1.0, PLACE.least))]
            lines += ["[[world.source]]", 'quantity = "temperature"', f"at = {at!r}"]
            lines += [f"peak = {rng.choice((5.0, 1e9, -1e9))!r}"]
            lines += [f"radius = {self.number(RADIUS, (1.0, 3.0))!r}"]
            lines += ["[[world.feature]]", 'kind = "bloom"', f"at = {at!r}"]
            lines += [f"radius = {self.number(RADIUS, (0.3,))!r}"]
        return "\n".join(lines) + "\n"

    def missions(self) -> str:
        """Return a missions file."""
        rng, lines = self.rng, list[str]()
        for number in range(rng.choice((1, 2))):
            lines += ["[[mission]]", f'name = "m{number}"', f"repeat = {rng.choice((0, 1, 2))}"]
            lines += [
                f"{key} = {self.time()!r}" for key in ("every", "safe_time") if rng.random() < 0.4
            ]
            for _ in range(rng.choice((1, 2))):
                item = f'item = {{ name = "x", mass = {self.number(MASS, (0.001,))!r} }}'
                actions = rng.choice((("measure",), ("take_photo",), ("pick_item", "release_item")))
                for action in actions:
                    lines += ["[[mission.trip]]", f'action = "{action}"', f"target = {self.spot()}"]
                    lines += [item] if len(actions) > 1 else []
                    lines += [f"source = {self.spot()}"] if rng.random() < 0.1 else []
                    lines += [
                        f"{key} = {self.time()!r}" for key in ("delay", "gap") if rng.random() < 0.3
                    ]
                    lines.append(f"priority = {rng.choice((0, 10**9, -(10**9)))}")
        return "\n".join(lines) + "\n"
