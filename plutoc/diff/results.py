"""Comparing what the apps say of the results of their actions."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.diff.both import Both
from plutoc.diff.messages import results as messages
from plutoc.diff.model import Change
from plutoc.graph.model import Graph, Shown
from plutoc.graph.results import key_of


def results(both: Both) -> Iterator[Change]:
    """Compare what is said, by action and, of what is measured, by quantity."""
    called = {**both.hooks}
    old = {
        (called.get(action, action), *rest): one
        for (action, *rest), one in _said(both.old.graph).items()
    }
    new = _said(both.new.graph)
    for key, now in new.items():
        was = old.get(key)
        if was is None:
            yield messages.result_added(now)
        elif (was.way, was.given) != (now.way, now.given):
            yield messages.result_changed(was, now)
    yield from (messages.result_removed(was) for key, was in old.items() if key not in new)


def _said(graph: Graph) -> dict[tuple[str, str, str], Shown]:
    return {key_of(one): one for one in graph.results if one.declaration}
