"""Where a mission goes on that was stopped."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.diff.both import Both
from plutoc.diff.model import Change
from plutoc.diff.roles import Role, role
from plutoc.diff.words import routes as words
from plutoc.graph.model import Node


def stops(both: Both) -> Iterator[Change]:
    """Tell where it goes on now, for the blocks that both apps have: once for all of a kind."""
    found: dict[tuple[tuple[str, ...], tuple[str, ...]], list[tuple[Node, Node]]] = {}
    for old, new in both.common():
        if role(new) is Role.GATE:  # no mission waits in a gate: what stands before it is told
            continue
        before = both.old.checked.resumes[old.name]
        after = both.new.checked.resumes[new.name]
        if {*both.old.called(before)} != {*after}:
            found.setdefault((before, after), []).append((old, new))
    for (before, after), nodes in found.items():
        was = tuple(old.name_span for old, _ in nodes)
        yield words.resumes_elsewhere([new for _, new in nodes], before, after, was)
