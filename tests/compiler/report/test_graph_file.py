"""The graph that a package carries as data: the very picture of the editor, a line for each part."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from plutoc.block import ANY_SAME, Block
from plutoc.compile import analyse
from plutoc.report.graph_file import graph_file
from plutoc.service.document import Document
from plutoc.service.picture.view import view
from plutoc.source import Source
from plutoc_blocks.clock.step import wait_for_time
from tests.paths import ROOT

EXAMPLES = sorted(ROOT.glob("examples/*/app.pluto"))
ENDS = ("start", "end")


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.parent.name)
def test_a_package_has_the_picture_of_the_editor(path: Path) -> None:
    """Blocks at the same places, edges with the same statuses, the same words on each kind."""
    text = path.read_text(encoding="utf-8")
    kept = json.loads(graph_file(analyse(Source("app.pluto", text))[0]))
    shown = view(Document(path="app.pluto", text=text), {})
    blocks = shown["blocks"]
    ends = shown["ends"]
    edges = shown["edges"]
    assert isinstance(blocks, list) and isinstance(ends, dict) and isinstance(edges, list)
    spots = {one["name"]: [one["x"], one["y"]] for one in kept["blocks"]}
    events = shown["events"]
    assert isinstance(events, list)
    drawn = {one["name"]: [one["x"], one["y"]] for one in (*blocks, *events)}
    assert spots == drawn | ends
    assert kept["kinds"] == {one["kind"]: one["doc"] for one in blocks}
    for one in (
        one for one in kept["blocks"] if one["name"] in {block["name"] for block in blocks}
    ):
        (same,) = (block for block in blocks if block["name"] == one["name"])
        assert (one["kind"], one.get("gate", False)) == (same["kind"], same["gate"])
    parts = ("source", "target", "statuses", "fork", "implicit")
    assert [{"fork": False, "implicit": False} | one for one in kept["edges"]] == [
        {part: one[part] for part in parts} for one in edges
    ]


def test_every_part_has_a_line() -> None:
    """So what changed in the graph is what a review shows."""
    text = graph_file(analyse(Source("app.pluto", EXAMPLES[0].read_text(encoding="utf-8")))[0])
    data = json.loads(text)
    assert len(text.splitlines()) == 8 + sum(map(len, data.values()))


def test_words_of_other_packages_stay_words() -> None:
    """What a kind does is another author's text."""
    checked = analyse(Source("app.pluto", EXAMPLES[0].read_text(encoding="utf-8")))[0]
    doc = 'Scans "a\\b" {kinds} </script>\u2028 🚁.'
    block = Block(name="GridScan", doc=doc, step=wait_for_time, transitions=ANY_SAME)
    nodes = tuple(replace(node, block=block) for node in checked.graph.nodes)
    strange = replace(checked, graph=replace(checked.graph, nodes=nodes))
    assert json.loads(graph_file(strange))["kinds"] == {"GridScan": doc}
