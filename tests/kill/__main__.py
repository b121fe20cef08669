"""Kills brains and gateways of real flights at random moments, and says what came of it.

    python -m tests.kill --brain 500 --gateway 100
    python -m tests.kill --brain 150 --gateway 50 --plan lookout

Every flight is resumed after each kill and judged at its end: nothing that was acknowledged may be
lost, no mission may hang, and nothing may be picked or released twice, counted by the simulated
world. One app is told of events while it is killed: each happens once, and one mission comes of it. The moments are drawn by the seed, but real processes meet them differently each time.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from random import Random
from tempfile import mkdtemp

from tests.kill.lives import Flight
from tests.kill.lookout import LOOKOUT, lookout_in
from tests.kill.painter import HOUSE, painter_in
from tests.kill.plans import PLANS
from tests.kill.trial import Tally, Trial
from tests.kit.apps import compiled
from tests.kit.campaign import Campaign

SPEEDS = (10.0, 20.0, 40.0)
"""How much faster than the clock time passes."""
MISHAPS = ("crash=0%", "crash=0%", "crash=5%,action=5%", "link=10%,action=10%")
"""What goes wrong besides."""
KILLS = (2, 7)
"""How many a flight gets at most."""
ALL = (*PLANS, HOUSE, LOOKOUT)
HOPELESS = 10
"""Flights in a row with nothing killed: then something else is wrong."""


class Flights:
    """Flights, until so many brains and gateways were killed."""

    def __init__(
        self, folder: Path, *, brains: int, gateways: int, seed: int, only: str | None = None
    ) -> None:
        self.tally = Tally()
        self._folder = folder
        self._brains = brains
        self._gateways = gateways
        self._seed = seed
        self._plans = [plan for plan in ALL if only in (None, plan.app)]
        self._sources = {plan.app: compiled(plan.app) / "src" for plan in PLANS}
        self._sources[HOUSE.app] = painter_in(folder / "painter")
        self._sources[LOOKOUT.app] = lookout_in(folder / "lookout")

    def _left(self) -> tuple[int, int]:
        """Return how many brains and gateways are still to be killed."""
        tally = self.tally
        return self._brains - tally.brains.total(), self._gateways - tally.gateways.total()

    def numbers(self) -> Iterator[int]:
        """Yield the numbers of the flights."""
        number = idle = 0
        while max(left := self._left()) > 0:
            yield number
            number, idle = number + 1, idle + 1 if left == self._left() else 0
            if idle == HOPELESS:
                raise AssertionError(f"{idle} flights in a row in which nothing could be killed")

    def fly(self, number: int) -> list[str]:
        """Fly, kill and resume; return what is wrong."""
        random = Random(f"{self._seed}/{number}")
        plan = self._plans[number % len(self._plans)]
        place = self._folder / f"flight{number}"
        place.mkdir(parents=True)
        (place / "go").touch()  # for the painter
        flight = Flight(
            app=plan.app,
            source=self._sources[plan.app],
            folder=place,
            speed=random.choice(SPEEDS),
            chance=["--seed", str(number), "--fail", random.choice(MISHAPS)],
        )
        victims = _victims(random, *self._left())
        return Trial(
            plan=plan, flight=flight, random=random, victims=victims, tally=self.tally
        ).run()


def _victims(random: Random, brains: int, gateways: int) -> list[str]:
    """Choose what one flight shall lose, no more than is still to be killed."""
    most = random.randint(*KILLS)
    all_of_them = ["brain"] * min(brains, most) + ["gateway"] * min(gateways, most)
    random.shuffle(all_of_them)
    return all_of_them[:most]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; 1 if anything was wrong."""
    campaign = Campaign("tests.kill", __doc__)
    campaign.unit = "flight"
    campaign.option("--brain", type=int, default=500, help="kills of the brain (default: 500)")
    campaign.option("--gateway", type=int, default=100, help="of the gateway (default: 100)")
    campaign.option("--seed", type=int, default=1, help="which moments (default: 1)")
    campaign.option("--plan", choices=[plan.app for plan in ALL], help="fly this one alone")
    campaign.option("--folder", type=Path, help="where to fly; default: a new one, named")
    campaign.in_time()
    options = campaign.parse(arguments)
    folder = options.folder or Path(mkdtemp(prefix="kill-"))
    print(f"flights in {folder}", flush=True)
    flights = Flights(
        folder,
        brains=options.brain,
        gateways=options.gateway,
        seed=options.seed,
        only=options.plan,
    )
    for number, wrong in campaign.each(flights.fly, flights.numbers()):
        if wrong:
            campaign.found(f"flight {number}", *wrong)
    return campaign.over(*flights.tally.lines())


if __name__ == "__main__":
    sys.exit(main())
