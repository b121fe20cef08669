"""What is said of where missions go, and of where they go on after a Stop."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.diff.both import Both, Side
from plutoc.diff.model import Change, Importance, Reroute, Spans
from plutoc.diff.phrases import ahead, listed, missions_of, named
from plutoc.graph.model import Node
from plutoc.source import Span
from plutoc_runtime.domain.status import Status


def step_added(both: Both, one: Reroute, steps: Sequence[str], spans: Spans) -> Change:
    """Missions pass some blocks before they come where they came straight before."""
    who = missions_of(both.new, one.new, one.statuses)
    status = one.statuses[0]
    first, *others = (ahead(both.new, [step], status) for step in steps)
    then = ahead(both.old, one.before, status)
    what = listed([first.now, *map(str, others)])
    return _route("step_added", both, one, f"{who} {what} before it {then}", steps, spans)


def step_removed(both: Both, one: Reroute, steps: Sequence[str], spans: Spans) -> Change:
    """Missions come straight where they passed some blocks before."""
    who = missions_of(both.new, one.new, one.statuses)
    status = one.statuses[0]
    then = ahead(both.new, one.after, status)
    what = listed([ahead(both.old, [step], status).no_longer for step in steps])
    return _route("step_removed", both, one, f"{who} {what}: it {then}", steps, spans)


def rerouted(both: Both, one: Reroute, spans: Spans) -> Change:
    """Missions go elsewhere."""
    who = missions_of(both.new, one.new, one.statuses)
    status = one.statuses[0]
    after = ahead(both.new, one.after, status)
    before = ahead(both.old, one.before, status)
    again = " once more" if one.after == (one.new.name,) else ""
    sentence = f"{who} {after.now}{again}; before, it {before.before}"
    return _route("rerouted", both, one, sentence, (), spans)


def swapped(
    both: Both, one: Reroute, second: str, statuses: tuple[Status, ...], spans: Spans
) -> Change:
    """Two steps have changed places: the one that `one` leads out of came first before."""
    status, first, side = statuses[0], one.new.name, both.new
    begun = status in (Status.UNEXECUTED, Status.STANDBY)
    who = "a mission" if begun else f"a {status.value} mission"
    now, then = ahead(side, [second], status).now, ahead(side, [first], status)
    return Change(
        kind="swapped",
        importance=_of_status(status),
        sentence=f"{who} {now} before it {then}; before, it was the other way round",
        blocks=(second, first),
        statuses=statuses,
        before=(first, second),
        after=(second, first),
        was=spans[0],
        now=spans[1],
    )


def _route(
    kind: str, both: Both, one: Reroute, sentence: str, steps: Sequence[str], spans: Spans
) -> Change:
    there = [both.new.graph.node.get(name) for name in one.after]
    there += [both.old.graph.node.get(name) for name in one.before]
    safety = Status.FAILED in one.statuses or any(n and n.block.retries for n in there)
    return Change(
        kind=kind,
        importance=Importance.SAFETY if safety else Importance.MISSIONS,
        sentence=sentence,
        blocks=tuple(dict.fromkeys((one.new.name, *steps))),
        statuses=one.statuses,
        before=one.before,
        after=one.after,
        was=spans[0],
        now=spans[1],
    )


def outcome_added(side: Side, node: Node, status: Status, leads: Sequence[str]) -> Change:
    """A block can say of a mission what it never said before."""
    then = ahead(side, leads, status)
    return Change(
        kind="outcome_added",
        importance=_of_status(status),
        sentence=f"a mission can now leave `{node.name}` {status.value}; then it {then}",
        blocks=(node.name,),
        statuses=(status,),
        after=tuple(leads),
        now=(node.name_span,),
    )


def outcome_removed(old: Node, new: Node, status: Status, led: Sequence[str]) -> Change:
    """A block never says of a mission what it could say before."""
    return Change(
        kind="outcome_removed",
        importance=_of_status(status),
        sentence=f"a mission no longer leaves `{new.name}` {status.value}",
        blocks=(new.name,),
        statuses=(status,),
        before=tuple(led),
        was=(old.name_span,),
        now=(new.name_span,),
    )


def _of_status(status: Status) -> Importance:
    return Importance.SAFETY if status is Status.FAILED else Importance.MISSIONS


def resumes_elsewhere(
    nodes: Sequence[Node], before: Sequence[str], after: Sequence[str], was: tuple[Span, ...]
) -> Change:
    """A mission that was stopped goes on at another block."""
    stopped = named([node.name for node in nodes], "or")
    return Change(
        kind="resumes_elsewhere",
        importance=Importance.MISSIONS,
        sentence=f"a mission stopped at {stopped} now goes on {_at(after)}; before, {_at(before)}",
        blocks=tuple(node.name for node in nodes),
        before=tuple(before),
        after=tuple(after),
        was=was,
        now=tuple(node.name_span for node in nodes),
    )


def _at(names: Sequence[str]) -> str:
    return f"at {named(names, 'or')}" if names else "nowhere"
