"""Flies random apps whose hooks write wherever they can, and sees that nothing stops but their own missions.

    python -m tests.hooks --apps 5000

Each app is simulated, and flown in virtual time with a journal, where its brain dies and another goes on; each time
also with hooks that write nothing. Nothing raises, no mission ends by a bug, none hangs, the good mission ends as it
does among good ones (unless an event breaks a flight of it off), and no two flights and no two completions are one.
In most apps events happen: raised by hooks, and told from outside at any moment. Each happens once, no attempt is
charged where one breaks a flight off, and no action on the way goes on when its flight is over.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from random import Random
from typing import Any, NamedTuple

from pluto_fleet.app import App, described
from pluto_fleet.flight.simulate import Sampling, simulate
from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.fleet_data import WorldData
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.events.declared import AlongField, TrackField
from pluto_fleet.shared.events.world import Mover
from pluto_fleet.shared.flow import asking
from plutoc.compile import analyse, planned
from plutoc.diagnostic import Rejected
from plutoc.source import Source
from tests.equivalence.flows import Package, packaged
from tests.hooks.judge import broken_off, ended_as, hanging, outlived, wrong
from tests.hooks.vandals import EVENTS, Vandals
from tests.kit import apps
from tests.kit.campaign import Campaign
from tests.kit.graphs.graph import random_source
from tests.kit.living import Living

LONGEST = 600.0
"""Seconds after which those that still fly are left to it."""
CALLS = 50
"""Of hooks between two launches, instead of a hundred thousand: with what these wait, and a new life that counts
anew, who goes round for ever has ended long before the longest time."""
WALKERS = WorldData(
    movers=(
        Mover(name="t1", kind="person", path=((1.0, 1.0), (4.0, 4.0)), speed=0.3, repeat=True),
        Mover(name="t2", kind="dog", path=((4.0, 1.0), (1.0, 3.0)), speed=0.5, starts=5.0),
    )
)
TRACKS = ("t1", "t2", "t3")
"""What trips follow and events are about; the last one is never seen."""
BATTERIES = (1e7, 1e7, 60.0)
"""Seconds that one lasts: with the last of these others must take over."""
NO_DRONE = "had no drone"
"""In the reason of who has waited in vain."""
HOMES = [(0.5, 0.5, 0.0)] * 10  # all of one home: it does not matter who flies
APART = [(0.5 + 1.5 * n, 0.5, 0.0) for n in range(10)]
"""Over a crash drones would be in each other's way at one home."""


def one_app(number: int) -> list[str]:
    """Fly one app, and return what must not be."""
    package = accepted(number)
    rng = Random(f"{number}/crashes")
    said = list[str]()
    crashes = [rng.uniform(0.0, 60.0) + 60.0 * n for n in range(rng.choice((1, 2, 3)))]
    for struck in ([], crashes):
        before, after = (_flown(package, number, active, struck, said) for active in (False, True))
        # over a crash drones may be in each other's way, and events come at other moments; a flight that an event
        # breaks off goes on with whichever drone is free then, from where that is; and who waits no longer than so
        # long for a drone may find that others have them, or have just had them
        is_alone = not struck and before.is_alone and after.is_alone
        if before.end != after.end if is_alone else " raised " in after.end[1]:
            said.append(f"the good mission ends {after.end}, and among good ones {before.end}")
    return said


def accepted(number: int) -> Package:
    """Return an app that the compiler accepts, drawn from its number."""
    rng = Random(f"hooks/{number}")
    while True:
        events = Random(f"hooks/{number}/events") if number % 4 else None
        plain = rng.random() < 0.3
        text = random_source(rng, (4, 6, 8, 10), strange=0.0, plain=plain, events=events)
        with suppress(Rejected):
            checked, _ = analyse(Source("app.pluto", text))
            if checked.graph.hooks:
                return packaged(planned(checked))


class Good(NamedTuple):
    """How the good mission has fared."""

    end: tuple[str, str]
    """Its status, and why; empty: it goes on."""
    is_alone: bool
    """Whether how it ends has nothing to do with where drones are, and whether others have them."""


def _flown(
    package: Package, number: int, active: bool, crashes: Sequence[float], said: list[str]
) -> Good:
    """Fly an app; return how the good mission fared."""
    vandals = Vandals(number, package.graph, active)
    events = list[Event]()
    given = package.app(vandals.module, patient=True)
    battery = Random(f"{number}/battery").choice(BATTERIES)
    category = replace(
        given.categories[0], speed=2.0, flight_time=battery, charge_time=60.0, actions=None
    )
    given = replace(given, categories=(category, *given.categories[1:]))
    app = described(given)
    vandals.trip = _trips_of(app, Random(f"{number}/new"), given.trip)
    vandals.mission = partial(given.mission, **_needed(app, "mission"))
    missions = _missions_of(
        app, _trips_of(app, Random(f"{number}/trips"), app.trip), Random(number)
    )
    homes = APART if crashes else HOMES
    fleet = replace(apps.fleet(*homes, categories=[category.name]), world=WALKERS)
    told = _told(package, Random(f"{number}/told"))
    usual = asking.MOST_CALLS
    asking.MOST_CALLS = CALLS
    try:
        if crashes:
            living = Living(app, *missions, on=fleet)
            for when in crashes:
                living.crash(when)
            for when, event, facts in told:
                living.at(when, partial(_tell, living, event, facts))
            living.run(LONGEST)
            ended = living.life.missions
            events = living.events
        else:
            how: dict[str, Any] = {
                "faults": apps.NO_FAULTS,
                "until": LONGEST,
                "on_event": events.append,
                "sampling": _telling(told),
            }
            ended = simulate(app, missions, fleet, seed=number, **how).missions
    finally:
        asking.MOST_CALLS = usual
    said += [one.reason for one in ended if "bug" in one.reason]
    said += wrong(events)
    said += outlived(vandals.looked, events)
    # one that is bad may wait for ever: its hooks say for what
    said += [one for one in hanging(events, LONGEST) if not (active and one.startswith("bad"))]
    end = ended_as("good", events)
    return Good(end, "good" not in broken_off(events) and NO_DRONE not in end[1])


def _told(package: Package, rng: Random) -> list[tuple[float, str, dict[str, Any]]]:
    """Draw of what the app is told while it flies, and when."""
    told = list[tuple[float, str, dict[str, Any]]]()
    for _ in range(rng.choice((0, 1, 2, 4)) if package.graph.events else 0):
        facts = {"id": f"told {rng.randint(1, 3)}", "at": [3.0, 3.0], "track": rng.choice(TRACKS)}
        told.append((rng.uniform(0.0, 90.0), rng.choice(EVENTS), facts))
    return sorted(told, key=lambda one: one[0])


def _tell(living: Living, event: str, facts: dict[str, Any]) -> None:
    if living.lives:  # a dead one hears nothing
        with suppress(BadInput):  # all is over
            living.life.control.raise_event(event, facts)


def _telling(told: Sequence[tuple[float, str, dict[str, Any]]]) -> Sampling | None:
    """Return what tells a simulation of this, every second of what has come."""
    left = [*told]

    def look(brain: Brain, now: float, drones: object) -> None:
        while left and left[0][0] <= now:
            _, event, facts = left.pop(0)
            brain.command({"command": "raise", "event": event, **facts}, now)

    return Sampling(every=1.0, look=look) if told else None


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


def _trips_of(app: App, rng: Random, new: Callable[..., Any]) -> Callable[..., Any]:
    """Return what makes trips of an app: with actions that its first drones can do."""
    can = app.categories[0].can
    able = [one for one in app.actions.values() if can(one.name) and not one.name.endswith("_item")]

    def trip(**given: Any) -> Any:
        action = rng.choice(able)
        parameters: dict[str, Any] = {
            one.name: one.default or _SAMPLES.get(one.name, "x") for one in action.parameters
        }
        more = {"action": action.name, "parameters": parameters, **_needed(app, "trip")}
        for field in app.fields:
            if isinstance(field, AlongField) and rng.random() < 0.6:
                more[field.name] = _along(rng.choice(field.actions))
            if isinstance(field, TrackField) and rng.random() < 0.3:
                more[field.name] = rng.choice(TRACKS)
        return new(**{**more, **given})

    return trip


def _along(action: str) -> dict[str, Any]:
    """Return an action on the way: one of the app's own goes on, a built-in one is done again and again."""
    return {"action": action, **({} if action == "look" else {"seconds": 1.0})}


_SAMPLES = {"for": 4.0}


def _needed(app: App, on: str) -> dict[str, Any]:
    needed: list[Any] = [one for one in app.fields if one.on.value == on and one.hint]
    return {one.name: one.sample for one in needed}


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
