"""What every picture shows: boxes and arrows, in the order of the source."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from plutoc.check.flow import ordered
from plutoc.check.model import Checked
from plutoc.graph.model import END, START


class Shape(Enum):
    """What a box stands for."""

    START = "where missions begin"
    END = "where missions end"
    GATE = "where forks close"
    BLOCK = "any other block"


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A block, `start` or `end`."""

    name: str
    kind: str
    """Empty for `start` and `end`."""
    shape: Shape


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """An edge, with the statuses that pass along it."""

    source: str
    target: str
    statuses: tuple[str, ...]
    fork: bool
    """It is a branch of a fork."""
    implicit: bool
    """The source has no such edge: missions end there all the same."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A graph as it is drawn."""

    title: str
    boxes: tuple[Box, ...]
    arrows: tuple[Arrow, ...]


def picture(checked: Checked) -> Picture:
    """Return what there is to draw."""
    graph = checked.graph
    branches = {edge for fork in checked.forks for edge in fork.branches}
    arrows = [
        Arrow(
            source=edge.source,
            target=edge.target,
            statuses=tuple(status.value for status in ordered(checked.carries[edge])),
            fork=edge in branches,
            implicit=False,
        )
        for edge in graph.edges
    ]
    for name in graph.node:
        left = tuple(status.value for node, status in checked.implicit_ends if node == name)
        if left:
            arrows.append(Arrow(source=name, target=END, statuses=left, fork=False, implicit=True))
    boxes = [Box(name=START, kind="", shape=Shape.START)]
    boxes.extend(
        Box(
            name=node.name,
            kind=node.block.name,
            shape=Shape.BLOCK if node.block.gate is None else Shape.GATE,
        )
        for node in graph.nodes
    )
    if any(arrow.target == END for arrow in arrows):
        boxes.append(Box(name=END, kind="", shape=Shape.END))
    return Picture(title=graph.title or graph.name, boxes=tuple(boxes), arrows=tuple(arrows))
