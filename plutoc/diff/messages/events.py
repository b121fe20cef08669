"""What is said of events, and of actions on the way."""

from __future__ import annotations

from plutoc.diff.both import Both
from plutoc.diff.model import Change, Importance, one_sided
from plutoc.diff.phrases import listed, named
from plutoc.graph.model import Event, Graph, Node
from plutoc.source import Span


def event_of_one(one: Event, *, is_new: bool) -> Change:
    """Something more, or less, can happen."""
    sentence = f"there is now the event `{one.name}`, which hooks and programs can raise"
    if not is_new:
        sentence = f"there is no event `{one.name}` any more: hooks and programs must not raise it"
    return one_sided(
        "event_added" if is_new else "event_removed",
        Importance.PEOPLE,
        sentence,
        fact=one.name,
        spans=_spans(one),
        is_new=is_new,
    )


def event_changed(old: Event, new: Event) -> Change:
    """An event says other things of itself."""
    now = f"says {_fields(new)}" if new.fields else "says nothing of its own"
    was = f"it said {_fields(old)}" if old.fields else "it said nothing of its own"
    return Change(
        kind="event_changed",
        importance=Importance.PEOPLE,
        sentence=f"the event `{new.name}` now {now}; before, {was}",
        before=tuple(one.name for one in old.fields),
        after=tuple(one.name for one in new.fields),
        was=_spans(old),
        now=_spans(new),
    )


def _fields(one: Event) -> str:
    said = []
    for field in one.fields:
        default = "" if field.default is None else ", which may be left out"
        said.append(f"`{field.name}` ({field.type.value}{default})")
    return listed(said)


def _spans(one: Event) -> tuple[Span, ...]:
    return (one.span,) if one.span else ()


def leads_elsewhere(both: Both, event: str) -> Change:
    """Missions are made of an event, or are no more, or begin elsewhere."""
    old = both.old.graph
    new = both.new.graph
    was = [edge.target for edge in old.outgoing.get(event, ())]
    now = [edge.target for edge in new.outgoing.get(event, ())]
    if not was:
        sentence = f"missions are now made of the event `{event}`, at {named(now)}"
    elif not now:
        sentence = f"no missions are made of the event `{event}` any more"
    else:
        sentence = (
            f"missions of the event `{event}` are now made at {named(now)}; before, at {named(was)}"
        )
    return Change(
        kind="event_leads",
        importance=Importance.MISSIONS,
        sentence=sentence,
        blocks=tuple(now),
        before=tuple(was) or None,
        after=tuple(now) or None,
        was=_arrows(old, event),
        now=_arrows(new, event),
    )


def _arrows(graph: Graph, event: str) -> tuple[Span, ...]:
    return tuple(edge.span for edge in graph.outgoing.get(event, ()))


def interrupt_of_one(node: Node, *, is_new: bool) -> Change:
    """An event breaks flights off, or does no more."""
    whose = " of its own mission" if dict(node.choices)["of"].name == "own" else ""
    sentence = (
        f"a flight is now broken off when `{node.event}`{whose} comes, and its trip waits again"
    )
    if not is_new:
        sentence = f"a flight is no longer broken off when `{node.event}`{whose} comes"
    return one_sided(
        "interrupt_added" if is_new else "interrupt_removed",
        Importance.SAFETY,
        sentence,
        blocks=(node.name,),
        fact=node.event,
        spans=(node.name_span,),
        is_new=is_new,
    )


def along_changed(both: Both, name: str, *, is_new: bool) -> Change:
    """An action is done on the way, or is no more."""
    spans = tuple(one.span for one in both.new.graph.actions if one.name == name)
    was = tuple(one.span for one in both.old.graph.actions if both.hooks.get(one.name) == name)
    how = "now done on the way" if is_new else "no longer done on the way"
    return Change(
        kind="along_changed",
        importance=Importance.PEOPLE,
        sentence=f"`{name}` is {how}: missions files must say so, too",
        before=not is_new,
        after=is_new,
        was=was,
        now=spans,
    )
