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

if TYPE_CHECKING:
    from pluto_fleet.app import App

POLICIES = ("nearest", "first", "least_used", "batch_optimal")
REPEATS = ("", " safe", " once", " ask")


def random_source(rng: Random) -> str:
    """Return an app with two categories, each of which can do what the other cannot."""
    own = [f"do{number}" for number in range(rng.choice((1, 1, 2)))]
    declared = [f"action {name}{rng.choice(REPEATS)}" for name in own]
    seen = rng.choice(("measure", "take_photo", "measure, take_photo"))
    carries = ", pick_item, release_item" if rng.random() < 0.3 else ""
    declared.append(f"category watcher{_habits(rng)} can {seen}")
    declared.append(f"category worker{_habits(rng)} can {', '.join(own)}{carries}")
    blocks = [
        "create = MissionCreator",
        f"allocate = DroneAllocator(policy: {rng.choice(POLICIES)})",
        "launch = TripLauncher",
    ]
    again = "allocate"
    if rng.random() < 0.4:
        blocks.append("wait = Clock")
        again = "wait"
    flows = [f"start -> create -> {again}{' -> allocate' if again == 'wait' else ''} -> launch"]
    last = _flight(rng, blocks, flows)
    flows.append(f"{last} -> {again} when STANDBY")
    if rng.random() < 0.8:
        blocks.append(f"retry = PriorityManager(max_attempts: {rng.choice((2, 3, 5))})")
        flows += [f"{last} -> retry when FAILED", f"retry -> {again} when STANDBY"]
        flows.append("retry -> end otherwise")
    else:
        flows.append(f"{last} -> end when FAILED")
    if rng.random() < 0.3:
        declared.append("evaluator judge_it")
        blocks.append("judge = MissionEvaluator(hook: judge_it)")
        flows += [f"{last} -> judge when COMPLETED", f"judge -> {again} when STANDBY"]
        flows.append("judge -> end when FAILED")
        last = "judge"
    if rng.random() < 0.3:
        blocks.append("round = MissionRepeater")
        flows += [f"{last} -> round when COMPLETED", f"round -> {again} when STANDBY"]
        last = "round"
    flows.append(f"{last} -> end when COMPLETED")
    return "\n".join(["pluto 1", "app drawn {", *declared, *blocks, *flows, "}", ""])


def _habits(rng: Random) -> str:
    given = {
        "speed": rng.choice(("0.5 m/s", "1 m/s")),
        "flight_time": rng.choice(("4 min", "7 min", "12 min")),
        "payload": "15 g",
        "reserve": rng.choice(("20 %", "40 %")),
    }
    chosen = [f"{name}: {value}" for name, value in given.items() if rng.random() < 0.4]
    return f"({', '.join(chosen)})" if chosen else ""


def _flight(rng: Random, blocks: list[str], flows: list[str]) -> str:
    """Draw what watches a flight; return the block from which a mission goes on."""
    blocks.append("watch = TripMonitor")
    limits = [kind for kind in ("TimerMonitor", "GapMonitor") if rng.random() < 0.35]
    if not limits:
        flows.append("launch -> watch")
        return "watch"
    for number, kind in enumerate(limits):
        blocks.append(f"limit{number} = {kind}(default: {rng.choice(('30 s', '2 min', '8 min'))})")
    blocks.append("first = GateFIFO")
    branches = ["watch", *(f"limit{number}" for number in range(len(limits)))]
    flows.append(f"launch -> [{', '.join(branches)}] -> first")
    return "first"


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
