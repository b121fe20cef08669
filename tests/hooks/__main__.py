"""Flies random apps whose hooks write wherever they can, and sees that nothing stops but their own missions.

    python -m tests.hooks --apps 5000

Each app is simulated, and flown in virtual time with a journal, where its brain dies and another goes on; each time
also with hooks that write nothing. Nothing raises, no mission ends by a bug, the good mission ends as it does among good
ones, and no two flights and no two completions are one.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from random import Random
from typing import Any

from pluto_fleet.app import App, described
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.flow import asking
from pluto_fleet.trials.invariants import Invariants
from pluto_fleet.trials.rules import AttemptsCountUp, NothingAfterTheEnd, TripsDoNotOverlap
from plutoc.check.model import Checked
from plutoc.compile import analyse, planned
from plutoc.diagnostic import Rejected
from plutoc.source import Source
from tests.equivalence.flows import Package, packaged
from tests.hooks.vandals import FLEET, Vandals, missions_of, trips_of
from tests.kit import apps
from tests.kit.campaign import Campaign
from tests.kit.graphs.graph import random_source
from tests.kit.living import Living

SMALL = (4, 6, 8, 10)
LONGEST = 1_500.0
"""Seconds after which those that still fly are left to it."""
RULES = (AttemptsCountUp, NothingAfterTheEnd, TripsDoNotOverlap)


def one_app(number: int) -> list[str]:
    """Fly one app, and return what must not be."""
    checked = accepted(number)
    package = packaged(planned(checked))
    ends: list[tuple[str, str]] = []
    said: list[str] = []
    for active in (False, True):
        for crashes in ((), _crashes(Random(f"{number}/crashes"))):
            events = list[Event]()
            try:
                good, reasons = _flown(package, number, active, crashes, events)
            except Exception as error:
                raise RuntimeError(f"{checked.graph.name}: {crashes or 'simulated'}") from error
            ends.append(good)
            said += [reason for reason in reasons if "bug" in reason]
            said += wrong(events) if active else []
    if ends[0] != ends[2]:  # over a crash their drones may be in each other's way
        said.append(f"the good mission ends {ends[2]}, and among good ones {ends[0]}")
    if " raised " in ends[3][1]:
        said.append(f"the good mission ends {ends[3]}")
    return said


def _crashes(rng: Random) -> tuple[float, ...]:
    return tuple(rng.uniform(0.0, 60.0) + 60.0 * n for n in range(rng.choice((1, 2, 3))))


def accepted(number: int) -> Checked:
    """Return an app that the compiler accepts, drawn from its number."""
    rng = Random(f"hooks/{number}")
    while True:
        text = random_source(rng, SMALL, strange=0.0, plain=rng.random() < 0.3)
        with suppress(Rejected):
            checked, _ = analyse(Source("app.pluto", text))
            if checked.graph.hooks:
                return checked


def _flown(
    package: Package, number: int, active: bool, crashes: Sequence[float], events: list[Event]
) -> tuple[tuple[str, str], list[str]]:
    """Fly an app; return how the good mission ended, and all reasons."""
    vandals = Vandals(f"{number}", package.graph, active)
    given = package.app(vandals.module(), patient=True)
    category = replace(given.categories[0], speed=2.0, flight_time=1e7)
    app = described(replace(given, categories=(category, *given.categories[1:])))
    vandals.trip = trips_of(app, Random(f"{number}/new"))
    missions = missions_of(app, trips_of(app, Random(f"{number}/trips")), Random(number))
    fleet = replace(
        FLEET, drones=tuple(replace(one, category=category.name) for one in FLEET.drones)
    )
    usual, asking.MOST_CALLS = asking.MOST_CALLS, 100
    try:
        if crashes:
            ended = _lives(app, missions, fleet, crashes, events)
        else:
            ended = _simulated(app, missions, fleet, number, events)
    finally:
        asking.MOST_CALLS = usual
    by_name = {one.name: one for one in ended}
    good = by_name["good"]
    return (good.status.value, good.reason), [one.reason for one in ended]


def _simulated(app: App, missions: Any, fleet: Any, seed: int, events: list[Event]) -> Any:
    try:
        outcome = simulate(
            app,
            missions,
            fleet,
            seed=seed,
            faults=apps.NO_FAULTS,
            until=LONGEST,
            on_event=events.append,
        )
    except BadInput as error:
        raise RuntimeError("it cannot be flown") from error
    return outcome.missions


def _lives(app: App, missions: Any, fleet: Any, crashes: Any, events: list[Event]) -> Any:
    living = Living(app, *missions, on=fleet)
    for when in crashes:
        living.crash(when)
    living.run(LONGEST)
    events += living.events
    return living.life.missions


def wrong(events: Sequence[Event]) -> Iterator[str]:
    """Yield what must not be in a run: two flights of one id, or two completions."""
    invariants = Invariants({}, RULES)
    for event in events:
        invariants.take(event)
    yield from invariants.found
    ids = ("mission", "trip", "round", "attempt")
    done = Counter(
        tuple(map(str, map(event.get, ids)))
        for event in events
        if event["event"] == "trip.completed"
    )
    yield from (f"completed {times} times: {of}" for of, times in done.items() if times > 1)
    for event in events:
        if event["event"] == "mission.created":
            names = event["trips"]
            assert isinstance(names, list)
            if len(names) != len({*names}):
                yield f"two trips of one name: {names}"


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
