"""What is said of what goes on at once: the times that are watched, branches, gates."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.block import Gate, Param
from plutoc.check.model import Fork
from plutoc.diff.model import Change, Importance, Reroute, Spans, one_sided
from plutoc.diff.phrases import amount, named
from plutoc.graph.model import END, Graph, Node


def limit_of_one(what: str, nodes: Sequence[Node], *, is_new: bool) -> Change:
    """A time in flight is watched in one of the apps only."""
    if is_new:
        fallback = _fallback(nodes[0])
        without = f"it is {fallback}" if fallback else "there is no limit"
        said = f"now watched: past it, the trip fails; where none is given, {without}"
    else:
        said = "no longer watched"
    return one_sided(
        "limit_added" if is_new else "limit_removed",
        Importance.SAFETY,
        f"a trip's {what} is {said}",
        blocks=tuple(node.name for node in nodes),
        fact=what,
        spans=tuple(node.name_span for node in nodes),
        is_new=is_new,
    )


def _fallback(node: Node) -> str | None:
    """Write the limit of those that name none, where a block has one and it is set."""
    for name, value in node.values[:1]:
        param = node.block.param(name)
        if isinstance(param, Param) and value is not None:
            return amount(value, param.type)
    return None


def branch_repeated(one: Reroute, name: str, was: int, now: int, spans: Spans) -> Change:
    """Several branches begin with one block, more or fewer than before."""
    return Change(
        kind="branch_repeated",
        importance=Importance.MISSIONS,
        sentence=f"`{name}` now runs {_often(now)}; before, {_often(was)}",
        blocks=tuple(dict.fromkeys((one.new.name, name))),
        statuses=one.statuses,
        before=was,
        after=now,
        was=spans[0],
        now=spans[1],
    )


def _often(number: int) -> str:
    return "once" if number == 1 else f"{'twice' if number == 2 else f'{number} times'} at once"


def branch_of_one(
    graph: Graph, one: Reroute, name: str, beside: Sequence[str], spans: Spans, *, is_new: bool
) -> Change:
    """Something goes on beside something else in one of the apps only."""
    node = graph.node.get(name)
    calls = f", which calls `{node.hook.name}`," if node and node.hook else ""
    runs = "leads straight to the gate beside" if node and node.block.gate else "runs beside"
    since = "now" if is_new else "no longer"
    return Change(
        kind="branch_added" if is_new else "branch_removed",
        importance=Importance.SAFETY if node and node.block.watches else Importance.MISSIONS,
        sentence=f"`{name}`{calls} {since} {runs} {named(beside)}",
        blocks=(one.new.name, *(() if name == END else (name,))),
        statuses=one.statuses,
        before=one.before,
        after=one.after,
        was=spans[0],
        now=spans[1],
    )


_NOW = {
    Gate.FIRST: "goes on with the first branch to arrive, and the others are called off",
    Gate.ALL: "waits for all its branches, and the worst of their statuses goes on",
}
_BEFORE = {
    Gate.FIRST: "the first branch to arrive went on, and the others were called off",
    Gate.ALL: "it waited for all its branches, and the worst of their statuses went on",
}


def gate_changed(fork: Fork, old: Node, new: Node, before: Gate, after: Gate) -> Change:
    """A fork closes by another rule."""
    return Change(
        kind="gate_changed",
        importance=Importance.SAFETY,
        sentence=f"the fork at `{fork.node}` ({fork.status.value}) now {_NOW[after]};"
        f" before, {_BEFORE[before]}",
        blocks=tuple(dict.fromkeys((fork.node, new.name))),
        statuses=(fork.status,),
        before=before.name.lower(),
        after=after.name.lower(),
        was=(old.name_span,),
        now=(new.name_span,),
    )


def order_changed(old: Fork, new: Fork, was: Sequence[str], now: Sequence[str]) -> Change:
    """Branches come in another order: it counts for what falls on one instant."""
    return Change(
        kind="order_changed",
        importance=Importance.FORM,
        sentence=f"at one instant, {named(now)} now take their turns in this order;"
        f" before, {named(was)}",
        blocks=(new.node, *now),
        statuses=(new.status,),
        before=tuple(was),
        after=tuple(now),
        was=tuple(edge.span for edge in old.branches[:1]),
        now=tuple(edge.span for edge in new.branches[:1]),
    )
