"""Misses no more deadlines by `earliest_deadline` than by `nearest`.

    python -m tests.deadlines --plans 1000

Each plan is drawn from its number: a fleet, missions of one to three trips, and deadlines of which few or most can be
kept. It is flown with both policies, and the missions that end after their deadline are counted. The campaign fails if
in more than one of 20 plans `earliest_deadline` misses more.
"""

from __future__ import annotations

import sys
from collections.abc import Coroutine, Mapping
from random import Random
from typing import Any

from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.keeper import put
from pluto_fleet.shared.domain.model import AfterTrip, Category
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.earliest_deadline import earliest_deadline
from pluto_fleet.shared.fleet.policies import Policy, nearest
from pluto_fleet.shared.flow.run import Run
from tests.kit import apps
from tests.kit.campaign import Campaign

SHARE = 0.95
"""In how many of the plans it is to miss no more, at least."""
A_TRIP = 30.0
"""About how many seconds a drone is busy with a trip: deadlines are drawn by it."""

TIRELESS = Category(name="scout", flight_time=100_000.0)

Deadlines = Mapping[str, float | None]


class Drawn:
    """One plan."""

    def __init__(self, number: int) -> None:
        chance = Random(f"deadlines/{number}")
        self.size = chance.choice((8.0, 12.0, 18.0))
        places = [(x, y, 0.0) for x in (0.5, 2.0, 3.5, 5.0) for y in (0.5, 2.0)]
        self.homes = chance.sample(places, chance.randint(1, 6))
        self.after = chance.choice(list(AfterTrip))
        self.trips = {
            f"m{n}": [self._place(chance) for _ in range(chance.choice((1, 1, 2, 3)))]
            for n in range(chance.randint(5, 30))
        }
        self.priorities = {name: chance.choice((0, 0, 0, 1)) for name in self.trips}
        whole = A_TRIP * sum(map(len, self.trips.values())) / len(self.homes)
        tight = chance.uniform(0.3, 1.5)
        self.deadlines: Deadlines = {
            name: None if chance.random() < 0.15 else chance.uniform(A_TRIP, A_TRIP + tight * whole)
            for name in self.trips
        }

    def _place(self, chance: Random) -> tuple[float, float]:
        return chance.uniform(0.5, self.size - 0.5), chance.uniform(0.5, self.size - 0.5)

    def flown(
        self,
        policy: Policy,
        kind: Category = TIRELESS,
        faults: Faults = apps.NO_FAULTS,
        max_airborne: int | None = None,
    ) -> apps.SimulationResult:
        """Fly it; what fails is tried again."""
        inner = apps.flow(policy=policy, attempts=3)

        def flow(run: Run[apps.Mission]) -> Coroutine[Any, Any, Status]:
            put(run.mission, deadline=self.deadlines[run.mission.name])
            return inner(run)

        missions = [
            apps.mission(
                name,
                *(
                    apps.trip(str(n), x, y, priority=self.priorities[name])
                    for n, (x, y) in enumerate(places)
                ),
            )
            for name, places in self.trips.items()
        ]
        tested = apps.app(flow, categories=(kind,))
        fleet = apps.fleet(*self.homes, after=self.after, max_airborne=max_airborne)
        return apps.fly(tested, *missions, on=fleet, faults=faults)

    def missed(self, policy: Policy) -> int:
        """Fly it, and return how many missions end after their deadline."""
        flown = self.flown(policy)
        ends = {str(e["mission"]): float(str(e["t"])) for e in apps.events(flown, "mission.ended")}
        due = ((ends[name], deadline) for name, deadline in self.deadlines.items())
        return sum(deadline is not None and end > deadline for end, deadline in due)


def missed(number: int) -> tuple[int, int]:
    """Return how many deadlines of a plan are missed: by `nearest`, and by `earliest_deadline`."""
    plan = Drawn(number)
    return plan.missed(nearest), plan.missed(earliest_deadline)


def main() -> int:
    """Fly all plans, and tell what was missed."""
    campaign = Campaign("tests.deadlines", __doc__)
    campaign.draws("plans", 1000)
    campaign.parse()
    found = [each for _, each in campaign.each(missed, campaign.numbers)]
    fine = sum(after <= before for before, after in found)
    fewer = sum(after < before for before, after in found)
    return campaign.over(
        f"missed by nearest: {sum(before for before, _ in found):,}",
        f"missed by earliest_deadline: {sum(after for _, after in found):,}",
        f"plans in which it misses no more: {fine} of {len(found)}; fewer: {fewer}",
        fails=["those are too few"] if fine < SHARE * len(found) else [],
    )


if __name__ == "__main__":
    sys.exit(main())
