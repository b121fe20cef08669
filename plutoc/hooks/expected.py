"""What the app expects of each of its hooks: which arguments it passes, and how."""

from __future__ import annotations

import ast
from dataclasses import dataclass, replace

from plutoc.block import HookKind
from plutoc.check.model import Checked
from plutoc.emit.python import python_result
from plutoc.emit.reactions import taken_by
from plutoc.emit.stubs import Stub, stubs
from plutoc.graph.model import Action, Graph, Hook, Parameter
from plutoc.source import Span
from plutoc_runtime.domain.status import Status

PASSED = {
    HookKind.ACTION: ("drone", "trip", "context"),
    HookKind.EVALUATOR: ("mission", "results"),
    HookKind.MODIFIER: ("mission", "context"),
    HookKind.POLICY: ("trip", "candidates"),
    HookKind.CREATOR: ("event", "context"),
}
"""What comes by position: the hook may call it as it likes."""
FOR_ALL = ("waiting", "drones", "now")
"""What a policy gets that has three parameters without a default: it chooses for all that wait."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Expected:
    """One function of hooks.py, as the app calls it."""

    kind: HookKind
    name: str
    passed: tuple[str, ...]
    """What it gets by position."""
    own: tuple[Parameter, ...]
    """What it gets by name: the parameters that the app declares."""
    returns: str
    """The type of what it returns, `object` where that is free."""
    emits: tuple[Status, ...] | None
    """The statuses that a modifier declares; None for any other hook."""
    may_wait: bool
    """It may be an `async def`."""
    result: str | None = None
    """The type that an action declares to return; None for any other hook."""
    events: tuple[str, ...] = ()
    """The classes of the events that a creator is called with."""
    span: Span
    """Where the app declares it."""
    first_line: str
    """As its `def` is written, types included."""
    stub: str
    """A whole function that flies as it is."""

    @property
    def own_names(self) -> tuple[str, ...]:
        """What it gets by name."""
        return tuple(parameter.name for parameter in self.own)


def expected(checked: Checked) -> tuple[Expected, ...]:
    """Return all hooks of an app, in the order of the source."""
    graph = checked.graph
    drafts = {stub.name: stub for stub in stubs(checked)}
    hooks = [_expected(each, drafts[each.name], graph) for each in graph.hooks]
    hooks += [_expected(each, drafts[each.name], graph) for each in graph.actions]
    return tuple(sorted(hooks, key=lambda hook: hook.span.start))


def as_defined(hook: Expected, function: ast.FunctionDef | ast.AsyncFunctionDef) -> Expected:
    """Return what is expected of a hook as it is written: it may wait, and a policy has one of two shapes."""
    if isinstance(function, ast.AsyncFunctionDef) and hook.may_wait:
        return replace(hook, first_line=f"async {hook.first_line.removeprefix('async ')}")
    arguments = function.args
    by_place = [*arguments.posonlyargs, *arguments.args]
    names = {arg.arg for arg in by_place[:2]}
    needed = len(by_place) - len(arguments.defaults)
    if hook.kind is not HookKind.POLICY or needed != 3 or names & set(hook.passed):
        return hook
    first_line = f"def {hook.name}{_SIGNATURE_FOR_ALL}:"
    stub = f"{first_line}\n    return ()"
    return replace(hook, passed=FOR_ALL, returns="Assignment", first_line=first_line, stub=stub)


_SIGNATURE_FOR_ALL = (
    "(waiting: Sequence[Waiting], drones: Sequence[Drone], now: float) -> Assignment"
)


def probes(checked: Checked) -> tuple[Expected, ...]:
    """Return what may stand in hooks.py besides: `pollinate_done`, asked after a crash in `pollinate`."""
    declared = {hook.name for hook in expected(checked)}
    names = ((action, f"{action.name}_done") for action in checked.graph.actions)
    return tuple(_probe(action, name) for action, name in names if name not in declared)


def _probe(action: Action, name: str) -> Expected:
    first_line = f"def {name}(drone: Drone, trip: Trip) -> bool | None:"
    return Expected(
        kind=HookKind.ACTION,
        name=name,
        passed=("drone", "trip"),
        own=(),
        returns="bool",
        emits=None,
        may_wait=True,
        span=action.span,
        first_line=first_line,
        stub=f"{first_line}\n    return None",
    )


def _expected(hook: Action | Hook, draft: Stub, graph: Graph) -> Expected:
    kind = HookKind.ACTION if isinstance(hook, Action) else hook.kind
    first_line = f"{draft.coroutine}def {draft.name}{draft.signature}:"
    return Expected(
        kind=kind,
        name=hook.name,
        passed=PASSED[kind],
        own=hook.parameters,
        returns=_returns(hook),
        emits=_emits(hook),
        may_wait=kind is not HookKind.POLICY,
        result=python_result(hook.returns) if isinstance(hook, Action) and hook.returns else None,
        events=taken_by(graph, hook) if isinstance(hook, Hook) else (),
        span=hook.span,
        first_line=first_line,
        stub="\n    ".join([first_line, *draft.lines]),
    )


def _returns(hook: Action | Hook) -> str:
    if isinstance(hook, Action):
        return python_result(hook.returns) if hook.returns else "object"
    if hook.kind is HookKind.MODIFIER:
        return "Status" if hook.emits else "None"
    wanted = {HookKind.EVALUATOR: "Verdict", HookKind.CREATOR: "Mission"}
    return wanted.get(hook.kind, "Drone")


def _emits(hook: Action | Hook) -> tuple[Status, ...] | None:
    if isinstance(hook, Action) or hook.kind is not HookKind.MODIFIER:
        return None
    return hook.emits
