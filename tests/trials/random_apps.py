"""Random apps for `plutoc test`: two categories, actions of their own, and fleets to match.

Each is an app that a person could have written, with hooks that do what they are asked to: all that
is found in one of them is a mistake of ours.
"""

from __future__ import annotations

from random import Random
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from pluto_fleet.app import described
from pluto_fleet.files.drones import DroneEntry
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import AfterTrip
from pluto_fleet.shared.hooks.context import Verdict
from plutoc.compile import analyse, planned
from plutoc.source import Source
from tests.equivalence.flows import packaged
from tests.kit.graphs.usual import calm

if TYPE_CHECKING:
    from pluto_fleet.app import App

REPEATS = ("", " safe", " once", " ask")


def random_source(rng: Random) -> str:
    """Return an app with two categories, each of which can do what the other cannot."""
    own = [f"do{number}" for number in range(rng.choice((1, 1, 2)))]
    seen = rng.choice(("measure", "take_photo", "measure, take_photo"))
    carries = ", pick_item, release_item" if rng.random() < 0.3 else ""
    return calm(
        rng,
        *(f"action {name}{rng.choice(REPEATS)}" for name in own),
        f"category watcher{_habits(rng)} can {seen}",
        f"category worker{_habits(rng)} can {', '.join(own)}{carries}",
    )


def _habits(rng: Random) -> str:
    given = {
        "speed": rng.choice(("0.5 m/s", "1 m/s")),
        "flight_time": rng.choice(("4 min", "7 min", "12 min")),
        "payload": "15 g",
        "reserve": rng.choice(("20 %", "40 %")),
    }
    chosen = [f"{name}: {value}" for name, value in given.items() if rng.random() < 0.4]
    return f"({', '.join(chosen)})" if chosen else ""


def random_app(rng: Random) -> App:
    """Return such an app, on the runtime in place; its hooks take their time and do no wrong."""
    package = packaged(planned(analyse(Source("app.pluto", random_source(rng)))[0]))
    hooks = SimpleNamespace(do0=_act, do1=_act, judge_it=_judge)
    return described(package.app(hooks, patient=True))


async def _act(_: object, __: object, context: Any) -> object:
    """Do something for a while."""
    await context.sleep(2.0)
    return 1.0


def _judge(*_: object) -> Verdict:
    """Be content."""
    return Verdict()


def random_fleet(rng: Random) -> FleetFile:
    """Return a fleet of both kinds; some stand near to each other, some stay where they land."""
    size = rng.choice(((4.0, 4.0), (10.0, 8.0), (30.0, 20.0)))
    names = ["watcher", "worker", *(rng.choice(("watcher", "worker")) for _ in range(3))]
    names = names[: rng.choice((2, 3, 4, 5))]
    step = rng.choice((0.6, 0.7))
    drones = tuple(
        DroneEntry(id=f"s{place + 1}", category=name, home=(0.5 + step * place, 0.5, 0.0))
        for place, name in enumerate(names)
    )
    return FleetFile(
        airspace=Airspace(size=size),
        drones=drones,
        after_trip=rng.choice((AfterTrip.HOME, AfterTrip.HOME, AfterTrip.STAY, AfterTrip.NEXT)),
        apart=rng.choice((0.5, 0.5, 0.3)),
        max_airborne=rng.choice((None, None, 1, 2)),
    )
