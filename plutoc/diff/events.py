"""Comparing events: what can happen, what is made of it, and which flights it breaks off."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.diff.both import Both, Side
from plutoc.diff.messages import events as messages
from plutoc.diff.model import Change
from plutoc.graph.model import Node


def events(both: Both) -> Iterator[Change]:
    """Compare the events of two apps, and what is done on the way."""
    yield from _declared(both)
    yield from _sources(both)
    yield from _broken_off(both)
    yield from _along(both)


def _declared(both: Both) -> Iterator[Change]:
    before = {event.name: event for event in both.old.graph.events}
    after = {event.name: event for event in both.new.graph.events}
    for name, now in after.items():
        was = before.get(name)
        if was is None:
            yield messages.event_of_one(now, is_new=True)
        elif was.fields != now.fields:
            yield messages.event_changed(was, now)
    yield from (
        messages.event_of_one(was, is_new=False)
        for name, was in before.items()
        if name not in after
    )


def _sources(both: Both) -> Iterator[Change]:
    """Tell of events that lead elsewhere."""
    old = both.old.graph
    new = both.new.graph
    for event in dict.fromkeys((*old.sources[1:], *new.sources[1:])):
        before = both.old.known(edge.target for edge in old.outgoing.get(event, ()))
        after = both.new.known(edge.target for edge in new.outgoing.get(event, ()))
        if before != after:
            yield messages.leads_elsewhere(both, event)


def _broken_off(both: Both) -> Iterator[Change]:
    """Tell which events break flights off that did not, and of those that do no more."""
    before = _interrupting(both.old)
    after = _interrupting(both.new)
    for key, node in after.items():
        if key not in before:
            yield messages.interrupt_of_one(node, is_new=True)
    for key, node in before.items():
        if key not in after:
            yield messages.interrupt_of_one(node, is_new=False)


def _interrupting(side: Side) -> dict[tuple[str | None, tuple[str, ...]], Node]:
    """Return the blocks that break flights off, by the event, and by whose it must be."""
    return {
        (node.event, tuple(one.name for _, one in node.choices)): node
        for node in side.graph.nodes
        if node.block.interrupts
    }


def _along(both: Both) -> Iterator[Change]:
    """Tell what can be done on the way now, and what no more; of an action of both apps alone."""
    old = both.old.graph
    new = both.new.graph
    kept = dict(both.hooks)
    before = {kept.get(name, name) for name in old.along}
    of_old = {kept.get(action.name, action.name) for action in old.actions}
    of_new = {action.name for action in new.actions}
    for name in (*new.along, *sorted(before)):
        own = name in of_old and name in of_new
        built_in = name not in of_old and name not in of_new
        if (own or built_in) and (name in before) != (name in new.along):
            yield messages.along_changed(both, name, is_new=name in new.along)
