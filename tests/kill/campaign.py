"""Many flights, until enough was killed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random

from tests.kill.lives import Flight
from tests.kill.painter import HOUSE, painter_in
from tests.kill.plans import PLANS
from tests.kill.tally import Tally
from tests.kill.trial import Trial
from tests.kit.apps import compiled

SPEEDS = (10.0, 20.0, 40.0)
"""How much faster than the clock time passes."""

MISHAPS = ("crash=0%", "crash=0%", "crash=5%,action=5%", "link=10%,action=10%")
"""What goes wrong besides."""

KILLS = (2, 7)
"""How many a flight gets at most."""

HOPELESS = 10
"""Flights in a row with nothing killed: then something else is wrong."""


def campaign(
    folder: Path, *, brains: int, gateways: int, seed: int, tell: Callable[[Tally], object]
) -> Tally:
    """Fly, kill and resume until so many brains and gateways were killed."""
    tally, number, idle = Tally(), 0, 0
    sources = {plan.app: compiled(plan.app, folder / "packages") / "src" for plan in PLANS}
    sources[HOUSE.app] = painter_in(folder / "painter") / "src"
    plans = (*PLANS, HOUSE)
    while idle < HOPELESS:
        left = (brains - tally.brains.total(), gateways - tally.gateways.total())
        if left[0] <= 0 and left[1] <= 0:
            break
        random = Random(f"{seed}/{number}")
        plan = plans[number % len(plans)]
        place = folder / f"flight{number}"
        place.mkdir()
        (place / "go").touch()  # for the painter
        flight = Flight(
            app=plan.app,
            source=sources[plan.app],
            folder=place,
            speed=random.choice(SPEEDS),
            chance=["--seed", str(number), "--fail", random.choice(MISHAPS)],
        )
        victims = _victims(random, *left)
        Trial(plan=plan, flight=flight, random=random, victims=victims, tally=tally).run()
        killed = left != (brains - tally.brains.total(), gateways - tally.gateways.total())
        number, idle = number + 1, 0 if killed else idle + 1
        tell(tally)
    if idle >= HOPELESS:
        tally.problems.append(f"{HOPELESS} flights in a row in which nothing could be killed")
    return tally


def _victims(random: Random, brains: int, gateways: int) -> list[str]:
    """Choose what one flight shall lose, no more than is still to be killed."""
    most = random.randint(*KILLS)
    all_of_them = ["brain"] * min(brains, most) + ["gateway"] * min(gateways, most)
    random.shuffle(all_of_them)
    return all_of_them[:most]
