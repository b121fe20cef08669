"""The stubs of hooks: typed and documented, and right as they stand."""

from __future__ import annotations

from dataclasses import dataclass, replace

from plutoc.block import IN_GRAPH, HookKind
from plutoc.check.model import Checked
from plutoc.emit import reactions
from plutoc.emit.python import PYTHON, UNITS, annotation, python_result, status_tuple
from plutoc.graph.model import Action, Graph, Hook, Parameter
from plutoc_runtime.domain.status import Status

EXPORTS = {
    "ActionFailed": "._runtime.domain.errors",
    "Again": "._runtime.fleet.own_policy",
    "Assignment": "._runtime.fleet.own_policy",
    "Category": "._runtime.domain.model",
    "Context": "._runtime.hooks.context",
    "Drone": "._runtime.domain.model",
    "Item": "._runtime.domain.model",
    "LiveDrone": "._runtime.hooks.context",
    "Mission": ".model",
    "Photo": "._runtime.domain.model",
    "Point": "._runtime.domain.model",
    "Result": ".model",
    "Results": ".model",
    "Status": "._runtime.domain.status",
    "Trip": ".model",
    "Verdict": "._runtime.hooks.context",
    "Waiting": ".model",
}
"""The types that hooks are written with, and where they are."""
_FOR_HOOKS = ("Context", "LiveDrone", "Verdict")
_FOR_POLICIES = ("Again", "Assignment", "Waiting")


OUTCOMES = (Status.STANDBY, Status.COMPLETED, Status.FAILED)
"""How a mission can stand when its trip is over."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stub:
    """One hook as it is first written."""

    name: str
    coroutine: str
    signature: str
    doc: list[str]
    lines: list[str]
    uses: tuple[str, ...]
    """The types of the package that it names."""


def stubs(checked: Checked) -> list[Stub]:
    """Return the stubs of all hooks, in the order in which the app declares them."""
    graph = checked.graph
    taken = set(in_order(graph))
    made = {
        action.name: (_along if action.along else _action)(action, taken)
        for action in graph.actions
    }
    made |= {hook.name: _hook(hook, checked, taken) for hook in graph.hooks}
    return [made[name] for name in in_order(graph)]


def exports_of(graph: Graph, *, former: bool) -> dict[str, str]:
    """Return what a package offers: without a hook, and without one left over, less is carried."""
    less: tuple[str, ...] = () if graph.hooks or graph.actions or former else _FOR_HOOKS
    if not has_policies(graph):
        less += _FOR_POLICIES
    there = {name: home for name, home in EXPORTS.items() if name not in less}
    return dict(sorted((there | reactions.exports(graph)).items()))


def has_policies(graph: Graph) -> bool:
    """Return whether the app declares a policy."""
    return any(hook.kind is HookKind.POLICY for hook in graph.hooks)


def in_order(graph: Graph) -> list[str]:
    """Return the names of all hooks, actions among them, as the app declares them."""
    actions = [(action.span.start, action.name) for action in graph.actions]
    hooks = [(hook.span.start, hook.name) for hook in graph.hooks]
    return [name for _, name in sorted(actions + hooks)]


def _action(action: Action, taken: set[str]) -> Stub:
    result = python_result(action.returns) if action.returns else "object"
    returns = annotation(result, taken)
    given = _RESULTS.get(result, "None")
    fixed = "drone: Drone, trip: Trip, context: Context"
    return Stub(
        name=action.name,
        coroutine="async ",
        signature=f"({fixed}{_keywords(action.parameters, taken)}) -> {returns}",
        doc=[
            f"Do the action {action.name}: the drone hovers at the trip's target.",
            "",
            *_units(action.parameters),
            "`context.live(drone)` asks the drone what it measures, and sets what is built onto it.",
            "What it returns goes to the result store; raise ActionFailed if it cannot be done.",
        ],
        lines=[_log(action.name), f"return {given}"],
        uses=("Context", "Drone", "Trip", *(("Photo",) if result == "Photo" else ())),
    )


_RESULTS = {
    "int": "0",
    "float": "0.0",
    "bool": "False",
    "str": '""',
    "Photo": "Photo(position=trip.target, width=0.0, height=0.0)",
}
"""What a stub returns, by its type."""


def _along(action: Action, taken: set[str]) -> Stub:
    at_target = _action(action, taken)
    given = _RESULTS.get(python_result(action.returns), "None") if action.returns else "None"
    doc = [
        f"Do {action.name} on the way: from the launch to the end of the last leg.",
        "",
        *_units(action.parameters),
        "`context.live(drone)` says where the drone is. It may return before; what it returns goes to",
        "the result store. Raise ActionFailed to fail the trip.",
    ]
    return replace(at_target, doc=doc, lines=[_log(action.name), f"return {given}"])


def _hook(hook: Hook, checked: Checked, taken: set[str]) -> Stub:
    match hook.kind:
        case HookKind.EVALUATOR:
            keywords = _keywords(hook.parameters, taken)
            units = ["", *_units(hook.parameters)] if _units(hook.parameters) else []
            verdict = f"{hook.name} accepts every mission as yet: write it in hooks.py"
            return Stub(
                name=hook.name,
                coroutine="",
                signature=f"(mission: Mission, results: Results{keywords}) -> Verdict",
                doc=["Judge a finished mission by what its actions gave.", *units],
                lines=[f'return Verdict(ok=True, log=("{verdict}",))'],
                uses=("Mission", "Results", "Verdict"),
            )
        case HookKind.CREATOR:
            events = reactions.taken_by(checked.graph, hook)
            return Stub(
                name=hook.name,
                coroutine="",
                signature=f"(event: {' | '.join(events)}, context: Context) -> Mission | None",
                doc=["Make a mission of an event; None makes none."],
                lines=[_log(hook.name), "return None"],
                uses=("Context", *events, "Mission"),
            )
        case HookKind.POLICY:
            return Stub(
                name=hook.name,
                coroutine="",
                signature="(trip: Trip, candidates: Sequence[Drone]) -> Drone | None",
                doc=["Choose the drone for a trip, of those that could fly it now; None waits."],
                lines=["return candidates[0]"],
                uses=("Drone", "Sequence", "Trip"),
            )
        case _:
            return _modifier(hook, checked, taken)


def _modifier(hook: Hook, checked: Checked, taken: set[str]) -> Stub:
    fixed = "mission: Mission, context: Context"
    keywords = _keywords(hook.parameters, taken)
    arriving = arriving_at(hook, checked)
    waits = bool(hook.emits) and Status.RUNNING in arriving and Status.RUNNING not in hook.emits
    lines = [_log(hook.name)]
    doc = ["Change the mission, or look at it; its status stays."]
    if hook.emits:
        *most, last = (status.name for status in hook.emits)
        declared = f"{', '.join(most)} or {last}" if most else last
        doc = [f"Say with which status the mission goes on: {declared}."]
        if waits:
            lines.append("await context.trip_ended(mission.current)")
            arriving = frozenset((*OUTCOMES, *(arriving - {Status.RUNNING})))
        lines.append(f"return {_outcome(hook, arriving)}")
    if _units(hook.parameters):
        doc += ["", *_units(hook.parameters)]
    return Stub(
        name=hook.name,
        coroutine="async " if waits else "",
        signature=f"({fixed}{keywords}) -> {'Status' if hook.emits else 'None'}",
        doc=doc,
        lines=lines,
        uses=("Context", "Mission", *(("Status",) if hook.emits else ())),
    )


def arriving_at(hook: Hook, checked: Checked) -> frozenset[Status]:
    """Return the statuses that missions can have where the hook is called."""
    blocks = [node.name for node in checked.graph.nodes if node.hook is hook]
    found = frozenset(status for name in blocks for status in checked.arrives[name])
    return found or frozenset((Status.RUNNING,))


def _outcome(hook: Hook, possible: frozenset[Status]) -> str:
    """Return what the stub returns: how the mission stands, where that is declared."""
    if possible <= frozenset(hook.emits):
        return "mission.status"
    kept = tuple(status for status in IN_GRAPH if status in possible and status in hook.emits)
    last = Status.FAILED if Status.FAILED in hook.emits else hook.emits[0]
    if kept in ((), (last,)):
        return f"Status.{last.name}"
    return f"mission.status if mission.status in {status_tuple(kept)} else Status.{last.name}"


def _keywords(parameters: tuple[Parameter, ...], taken: set[str]) -> str:
    if not parameters:
        return ""
    typed = (f"{p.name}: {annotation(PYTHON[p.type], taken)}" for p in parameters)
    return f", *, {', '.join(typed)}"


def _units(parameters: tuple[Parameter, ...]) -> list[str]:
    with_units = [f"`{p.name}` is {UNITS[p.type]}" for p in parameters if p.type in UNITS]
    return [f"{', '.join(with_units)}."] if with_units else []


def _log(name: str) -> str:
    return f'context.log("{name} does nothing yet: write it in hooks.py")'
