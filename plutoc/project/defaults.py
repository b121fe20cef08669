"""Defaults that were others when a package was compiled: its app is another one without a change of its source."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from plutoc.block import Choice
from plutoc.check.model import Checked
from plutoc.emit.write import Changes
from plutoc.graph.model import Choose, Graph, Node

Seam = tuple[int, int]

_SEAM = re.compile(r"^SEAM = \((\d{1,4}), (\d{1,4})\)$", re.MULTILINE)


def seam_path(graph: Graph) -> str:
    """Return the file of an app's package that says of which seam it is."""
    return f"src/{graph.name}/_runtime/domain/app.py"


def seam_in(text: str) -> Seam | None:
    """Return the seam that such a file says, if it says one."""
    found = _SEAM.search(text)
    return (int(found[1]), int(found[2])) if found else None


def as_compiled(checked: Checked, seam: Seam | None) -> Checked:
    """Return an app with the defaults that it had when it was compiled for a seam; None: with today's."""
    if seam is None:
        return checked
    nodes = tuple(_then(node, seam) for node in checked.graph.nodes)
    return replace(checked, graph=replace(checked.graph, nodes=nodes))


def _then(node: Node, seam: Seam) -> Node:
    then = {name: was for name, _, was in _others(node, seam)}
    if not then:
        return node
    choices = tuple(
        (name, Choose(name=then.get(name, chosen.name), hook=chosen.hook))
        for name, chosen in node.choices
    )
    return replace(node, choices=choices)


def _others(node: Node, seam: Seam) -> Iterator[tuple[str, str, str]]:
    """Yield what a block leaves to the default that was another one: its name, what it is, what it was."""
    for name, chosen in node.choices:
        param = node.block.param(name)
        if isinstance(param, Choice) and param.earlier is not None and not chosen.is_given:
            was, until = param.earlier
            if seam < until:
                yield name, chosen.name, was


def told(checked: Checked, changes: Changes) -> list[str]:
    """Return a sentence for each default that is another than in the package as it is on the disk."""
    path = seam_path(checked.graph)
    texts = [change.before for change in changes.files if change.path == path]
    seam = seam_in(texts[0]) if texts and texts[0] is not None else None
    if seam is None:
        return []
    return [
        f"`{node.name}` names no `{name}`: that is `{now}` from now on, and was `{was}`, which"
        f" `{node.block.name}({name}: {was})` keeps"
        for node in checked.graph.nodes
        for name, now, was in _others(node, seam)
    ]
