"""Flies random apps whose hooks write wherever they can, and sees that nothing stops but their own missions.

    python -m tests.hooks --apps 5000

Each app is simulated, and flown in virtual time with a journal, where its brain dies and another goes on; each time
also with hooks that write nothing. Nothing raises, no mission ends by a bug, the good mission ends as it does among good
ones, and no two flights and no two completions are one.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from random import Random
from typing import Any

from pluto_fleet.app import App, described
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.flow import asking
from pluto_fleet.trials.invariants import Invariants
from pluto_fleet.trials.rules import AttemptsCountUp, NothingAfterTheEnd, TripsDoNotOverlap
from plutoc.compile import analyse, planned
from plutoc.diagnostic import Rejected
from plutoc.source import Source
from tests.equivalence.flows import Package, packaged
from tests.hooks.vandals import Vandals
from tests.kit import apps
from tests.kit.campaign import Campaign
from tests.kit.graphs.graph import random_source
from tests.kit.living import Living

LONGEST = 1_500.0
"""Seconds after which those that still fly are left to it."""
CALLS = 100  # of hooks between two launches, instead of a hundred thousand
RULES = (AttemptsCountUp, NothingAfterTheEnd, TripsDoNotOverlap)
HOMES = [(0.5, 0.5, 0.0)] * 10  # all of one home: it does not matter who flies


def one_app(number: int) -> list[str]:
    """Fly one app, and return what must not be."""
    package = accepted(number)
    rng = Random(f"{number}/crashes")
    said = list[str]()
    crashes = [rng.uniform(0.0, 60.0) + 60.0 * n for n in range(rng.choice((1, 2, 3)))]
    for struck in ([], crashes):
        before, after = (_flown(package, number, active, struck, said) for active in (False, True))
        # over a crash drones may be in each other's way
        if before != after if not struck else " raised " in after[1]:
            said.append(f"the good mission ends {after}, and among good ones {before}")
    return said


def accepted(number: int) -> Package:
    """Return an app that the compiler accepts, drawn from its number."""
    rng = Random(f"hooks/{number}")
    while True:
        text = random_source(rng, (4, 6, 8, 10), strange=0.0, plain=rng.random() < 0.3)
        with suppress(Rejected):
            checked, _ = analyse(Source("app.pluto", text))
            if checked.graph.hooks:
                return packaged(planned(checked))


def _flown(
    package: Package, number: int, active: bool, crashes: Sequence[float], said: list[str]
) -> tuple[str, str]:
    """Fly an app; return how the good mission ended."""
    vandals = Vandals(number, package.graph, active)
    events = list[Event]()
    given = package.app(vandals.module, patient=True)
    category = replace(given.categories[0], speed=2.0, flight_time=1e7, actions=None)
    app = described(replace(given, categories=(category, *given.categories[1:])))
    vandals.trip = _trips_of(app, Random(f"{number}/new"))
    missions = _missions_of(app, _trips_of(app, Random(f"{number}/trips")), Random(number))
    fleet = apps.fleet(*HOMES, categories=[category.name])
    usual = asking.MOST_CALLS
    asking.MOST_CALLS = CALLS
    try:
        if crashes:
            living = Living(app, *missions, on=fleet)
            for when in crashes:
                living.crash(when)
            living.run(LONGEST)
            ended = living.life.missions
            events = living.events
        else:
            how: dict[str, Any] = {
                "faults": apps.NO_FAULTS,
                "until": LONGEST,
                "on_event": events.append,
            }
            ended = simulate(app, missions, fleet, seed=number, **how).missions
    finally:
        asking.MOST_CALLS = usual
    said += [one.reason for one in ended if "bug" in one.reason]
    said += wrong(events)
    return next((one.status.value, one.reason) for one in ended if one.name == "good")


def _missions_of(app: App, trip: Callable[..., Any], rng: Random) -> list[Any]:
    """Return a good mission and two bad ones; the trips of those are called so, too."""
    made = []
    for place, (name, own) in enumerate((("good", ""), ("bad one", "bad "), ("bad two", "bad "))):
        spots = [(rng.uniform(1, 4), rng.uniform(1, 4), 1.2) for _ in range(rng.choice((1, 2, 3)))]
        trips = [trip(name=f"{own}{n}", target=spot, index=n) for n, spot in enumerate(spots)]
        mission = app.mission(name=name, index=place, trips=trips, **_needed(app, "mission"))
        if hasattr(mission, "repeat"):
            mission.repeat = rng.choice((0, 1))
        made.append(mission)
    return made


def _trips_of(app: App, rng: Random) -> Callable[..., Any]:
    """Return what makes trips of an app: with actions that its first drones can do."""
    can = app.categories[0].can
    able = [one for one in app.actions.values() if can(one.name) and not one.name.endswith("_item")]

    def trip(**given: Any) -> Any:
        action = rng.choice(able)
        parameters = {one.name: one.default or "x" for one in action.parameters}
        more = {"action": action.name, "parameters": parameters, **_needed(app, "trip")}
        return app.trip(**{**more, **given})

    return trip


def _needed(app: App, on: str) -> dict[str, Any]:
    needed: list[Any] = [one for one in app.fields if one.on.value == on and one.hint]
    return {one.name: one.sample for one in needed}


def wrong(events: Sequence[Event]) -> list[str]:
    """Return what must not be in a run: two flights of one id, or two completions."""
    invariants = Invariants({}, RULES)
    for event in events:
        invariants.take(event)
    done = Counter(
        tuple(str(event[fact]) for fact in ("mission", "trip", "round", "attempt"))
        for event in events
        if event["event"] == "trip.completed"
    )
    return invariants.found + [f"completed {n} times: {of}" for of, n in done.items() if n > 1]


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly what the command line asks for."""
    campaign = Campaign("tests.hooks", __doc__)
    campaign.draws("apps", 5000)
    campaign.parse(arguments)
    for number, said in campaign.each(one_app, campaign.numbers):
        if said:
            campaign.found(f"app {number}", *said[:5])
    return campaign.over()


if __name__ == "__main__":
    sys.exit(main())
