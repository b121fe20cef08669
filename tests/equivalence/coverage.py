"""What a campaign has seen: of graphs, and of what happened when they were flown.

A test that never met a nested fork or a safe time that ran out says nothing of them. So each kind
of thing is counted, and what never occurred is a failure of its own.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from plutoc.block import Gate
from plutoc.graph.model import Node
from plutoc.plan.model import Body, Call, Dispatch, Join, Loop, Plan, Step, Switch
from plutoc_runtime.domain.trace import Event
from tests.equivalence.fly import Record
from tests.equivalence.worlds import World
from tests.kit.graphs import others

RETRIES = {0: "retries without bound", 1: "retries at most once", 3: "retries at most three times"}


def of_graph(plain: Plan, optimised: Plan) -> Iterator[str]:
    """Yield what a graph has, each thing once."""
    found = [*_of_blocks(plain.checked.graph.nodes), *_of_steps(plain.body)]
    found += [f"optimised: {type(step).__name__}" for step in _steps(optimised.body)]
    if plain.body != optimised.body:
        found.append("the two plans differ")
    calls = Counter(step.node.name for step in _steps(plain.body) if isinstance(step, Call))
    if any(calls[name] > 1 for name in plain.checked.entries):
        found.append("an entry by a copy")
    if any(isinstance(step, Dispatch) and step.entries for step in plain.body):
        found.append("an entry by a case")
    yield from dict.fromkeys(found)


def _of_blocks(nodes: Sequence[Node]) -> Iterator[str]:
    for node in nodes:
        yield f"block: {node.block.name}"
        values = dict(node.values)
        if node.block.bound is not None and values[node.block.bound] in RETRIES:
            yield RETRIES[int(str(values[node.block.bound]))]
        if node.block.emits_by_hook:
            emits = node.hook is not None and node.hook.emits
            yield "modifier with emits" if emits else "modifier without emits"
        if values.get("allocate_within") is not None:
            yield "allocate_within"
        yield from (f"policy: {'own' if c.hook else c.name}" for _, c in node.choices)
    allocators = {node.choices for node in nodes if node.block.allocates}
    if len(allocators) > 1:
        yield "allocators of different policies"


def _of_steps(body: Body, depth: int = 0, loops: int = 0) -> Iterator[str]:
    for step in body:
        yield f"plain: {type(step).__name__}"
        inner = loops + isinstance(step, Loop)
        if isinstance(step, Loop) and loops:
            yield "a loop in a loop"
        if isinstance(step, Join):
            yield "gate: first" if step.gate.block.gate is Gate.FIRST else "gate: all"
            if depth:
                yield "a fork in a fork" if depth == 1 else "a fork in a fork in a fork"
            if loops:
                yield "a fork in a loop"
        for each in bodies_of(step):
            deeper = isinstance(step, Join)
            yield from _of_steps(each, depth + deeper, 0 if deeper else inner)


def _steps(body: Body) -> Iterator[Step]:
    for step in body:
        yield step
        for each in bodies_of(step):
            yield from _steps(each)


def bodies_of(step: Step) -> Iterator[Body]:
    """Yield the bodies within a step, those of a fork's branches too."""
    match step:
        case Join(branches=branches):
            yield from (branch.body for branch in branches)
        case Switch(arms=arms):
            yield from (arm.body for arm in arms)
        case Dispatch(cases=cases):
            yield from (case.body for case in cases)
        case Loop(body=body):
            yield body
        case _:
            pass


REASONS = (
    *(
        "missed its deadline",
        "longer than its safe time",
        "of the previous one",
        "had no drone within",
    ),
    *("crashed at", "lost its link", "ran out of battery", "could not do it", "slipped"),
    *("has had no news", "saw nothing", "one too many"),
    *("failed the trip", "must return", "raised", "no drone of the fleet", "aboard"),
)
"""What a reason says: of limits that ran out, mishaps, and hooks that did wrong."""
EVENTS = (
    *("trip.delayed", "trip.reset", "drone.charging", "drone.lost"),
    *("mission.extended", "mission.judged", "mission.repeated", "mission.modified"),
    *("event.raised", "event.over", "trip.interrupted", "trip.skipped", "trip.handed_over"),
    "action.result",
)


def of_run(world: World, record: Record) -> Iterator[str]:
    """Yield what happened in a run, each thing once."""
    found = [kind for kind in map(_kind, record.events) if kind in EVENTS]
    for event in record.events:
        reason = str(event.get("reason", ""))
        found += [text for text in REASONS if text in reason]
    found += _at_one_instant(record.events)
    if record.coincidences:
        found.append("a trip that ended just in time")
    if record.diary:
        found.append("a hook was called")
    if not any(_kind(event) == "trip.failed" for event in record.events):
        found.append("no trip failed")
    if record.ends and record.ends[0].startswith("BadInput"):
        found.append("missions waited for ever")
    if len(world.missions) > 1:
        found.append("several missions")
    if world.entry is not None:
        found.append("missions that go on")
    yield from dict.fromkeys(found)


def _at_one_instant(events: Sequence[Event]) -> Iterator[str]:
    ends: dict[object, object] = {}
    for event in events:
        if _kind(event) in ("trip.completed", "trip.failed"):
            if ends.get(event["t"], event["mission"]) != event["mission"]:
                yield "two trips ended at one instant"
            ends[event["t"]] = event["mission"]


def _kind(event: Event) -> str:
    return str(event["event"])


WANTED = (
    *("a fork in a fork", "a fork in a fork in a fork", "a fork in a loop", "a loop in a loop"),
    *("gate: first", "gate: all", "plain: Dispatch", "plain: Switch", "plain: Break"),
    *(f"block: {kind}" for kind in ("MissionCreator", "Clock", "DroneAllocator", "TripLauncher")),
    *(f"block: {kind}" for kind in ("TripMonitor", "TimerMonitor", "GapMonitor", "GateFIFO")),
    *(f"block: {kind}" for kind in ("GateFunnel", "MissionRepeater", "MissionEvaluator")),
    *(f"block: {kind}" for kind in ("MissionModifier", "PriorityManager")),
    *(f"block: {kind}" for kind in ("EventMonitor", "TripSkipper")),
    *(f"block: {kind}" for kind in others.BLOCKS),
    *RETRIES.values(),
    *("modifier with emits", "modifier without emits", "allocate_within"),
    *(f"policy: {name}" for name in ("nearest", "first", "least_used", "batch_optimal", "own")),
    "allocators of different policies",
    *EVENTS,
    *REASONS,
    *("two trips ended at one instant", "a trip that ended just in time", "a hook was called"),
    *("no trip failed", "several missions", "missions that go on", "plain: Arrived"),
    *("an entry by a copy", "an entry by a case"),
)
"""What must have occurred, or the campaign has shown nothing of it."""


def missed(seen: Counter[str]) -> list[str]:
    """Return what should have occurred and has not."""
    return [what for what in WANTED if not seen[what]]
