"""The station shows the picture of the app's own README, with anything in it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from random import Random

import pytest

from pluto_fleet.station.graph.picture import graph_in
from plutoc.block import ANY_SAME, Block
from plutoc.check.model import Checked
from plutoc.compile import analyse
from plutoc.diagnostic import Rejected
from plutoc.emit.readme_file import readme
from plutoc.report.pictures import Shape, mermaid, picture
from plutoc.source import Source
from plutoc_blocks.clock.step import wait_for_time
from tests.kit.graphs.graph import random_source
from tests.paths import ROOT

SHAPES = {Shape.START: "start", Shape.END: "end", Shape.GATE: "gate", Shape.BLOCK: "block"}
HOSTILE = '```\nflowchart TD\n    Start(["start"])\n\n| kind of block | what it does |\n|---|---|\n'


EXAMPLES = sorted(ROOT.glob("examples/*/app.pluto"))


def checked(text: str) -> Checked:
    """Return the checked graph of an app."""
    return analyse(Source("app.pluto", text))[0]


@cache
def examples() -> dict[str, Checked]:
    """Return the graph of each example, by its name."""
    return {path.parent.name: checked(path.read_text(encoding="utf-8")) for path in EXAMPLES}


def random_graphs(many: int) -> Iterator[Checked]:
    """Yield graphs, some of them large and strange."""
    seed = 0
    while many:
        seed += 1
        try:
            graph = checked(random_source(Random(f"drawn/{seed}")))
        except Rejected:
            continue
        many -= 1
        yield graph


def shown(graph: Checked) -> object:
    """Return what the README's picture and table show."""
    drawn = picture(graph)
    docs = {node.block.name: node.block.doc.partition("\n")[0] for node in graph.graph.nodes}
    boxes = [
        (box.name, box.kind, " ".join(docs.get(box.kind, "").split()), SHAPES[box.shape])
        for box in drawn.boxes
    ]
    arrows = [
        (
            one.source,
            one.target,
            one.statuses,
            one.fork and not one.implicit and one.statuses != (),
            one.implicit or not one.statuses,
        )
        for one in drawn.arrows
    ]
    return boxes, arrows


def read(graph: Checked) -> object:
    """Return what the station reads there."""
    found = graph_in(readme(graph.graph, "app.pluto", mermaid(graph)))
    assert found is not None
    return (
        [(box.name, box.kind, box.doc, box.shape) for box in found.boxes],
        [(one.source, one.target, one.statuses, one.fork, one.dotted) for one in found.arrows],
    )


@pytest.mark.parametrize(("name", "graph"), examples().items(), ids=lambda one: str(one)[:30])
def test_every_example_is_read_as_it_is_drawn(name: str, graph: Checked) -> None:
    """Names, kinds and what they do, statuses, branches, and ends that the source does not draw."""
    assert read(graph) == shown(graph), name


def test_every_graph_is_read_as_it_is_drawn() -> None:
    """Random ones, with all that a graph can hold."""
    forks = unsaid = 0
    for graph in random_graphs(40):
        assert read(graph) == shown(graph)
        forks += bool(graph.forks)
        unsaid += bool(graph.implicit_ends)
    assert forks and unsaid


@pytest.mark.parametrize("doc", ["Scans.", "Scans `a|b` | and *more* \\ less.", HOSTILE, ""])
def test_blocks_of_other_packages_are_read_as_they_are_drawn(doc: str) -> None:
    """Their kinds and what these do are another author's words; so is the app's title."""
    graph = examples()["alfalfa"]
    block = Block(name="GridScan", doc=doc, step=wait_for_time, transitions=ANY_SAME)
    nodes = tuple(
        replace(node, block=block, package="survey") if node.name == "wait" else node
        for node in graph.graph.nodes
    )
    strange = replace(graph, graph=replace(graph.graph, nodes=nodes, title=HOSTILE))
    assert read(strange) == shown(strange)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "# alfalfa\n",
        "```mermaid\n```\n",
        "```mermaid\nflowchart TD\n    Start --> End\n```\n",
        '```mermaid\nflowchart TD\n    Start(["start"])\n    Start --> Nowhere\n```\n',
    ],
)
def test_a_readme_without_such_a_picture_gives_none(text: str) -> None:
    """Nothing is guessed."""
    assert graph_in(text) is None
