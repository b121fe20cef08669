"""Where blocks stand: no two on each other, edges forward, and steady while an app is written."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from networkx import DiGraph, has_path

from plutoc.report.layout import GRID, HEIGHT, WIDTH, Point, laid_out
from plutoc.service.document import Document
from plutoc.service.picture.positions import positions_file, positions_in
from tests.paths import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*/app.pluto"))
NAMES = [f"b{i}" for i in range(12)]
WAYS = st.lists(
    st.tuples(st.sampled_from(["start", *NAMES]), st.sampled_from([*NAMES, "end"])), max_size=25
)


def apart(found: dict[str, Point]) -> bool:
    spots = list(found.values())
    return not any(
        abs(x - u) < WIDTH and abs(y - v) < HEIGHT
        for i, (x, y) in enumerate(spots)
        for u, v in spots[i + 1 :]
    )


@given(WAYS, st.integers(0, 12))
def test_no_two_boxes_stand_on_each_other(ways: list[tuple[str, str]], count: int) -> None:
    names = NAMES[:count]
    there = {"start", "end", *names}
    ways = [way for way in ways if there.issuperset(way)]
    found = laid_out(names, ways, {})
    assert found.keys() == there
    assert apart(found)
    assert all(x % GRID == y % GRID == 0 for x, y in found.values())
    assert laid_out(names, ways, {}) == found


@given(WAYS, st.tuples(st.integers(-100, 3000), st.integers(-100, 500)))
def test_what_was_moved_stands_there_and_no_other_on_it(
    ways: list[tuple[str, str]], spot: Point
) -> None:
    found = laid_out(NAMES, ways, {"b3": spot})
    assert found["b3"] == spot
    others = {name: at for name, at in found.items() if name != "b3"}
    assert all(abs(x - spot[0]) >= WIDTH or abs(y - spot[1]) >= HEIGHT for x, y in others.values())


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.parent.name)
def test_edges_lead_down_but_for_those_that_close_a_loop(path: Path) -> None:
    graph = Document(path="", text=path.read_text()).graph
    ways = [(edge.source, edge.target) for edge in graph.edges]
    found = laid_out(list(graph.node), ways, {}, graph.sources[1:])
    back = [way for way in ways if found[way[0]][1] >= found[way[1]][1]]
    there = DiGraph(ways)
    assert all(has_path(there, target, source) for source, target in back)
    assert apart(found)
    assert found["start"][1] == 0
    assert max(y for _, y in found.values()) == found["end"][1]


def test_a_block_at_the_end_of_a_branch_leaves_those_before_where_they_were() -> None:
    names, ways = ["a", "b", "c"], [("start", "a"), ("a", "b"), ("b", "c"), ("c", "end")]
    before = laid_out(names, ways, {})
    after = laid_out([*names, "d"], [*ways[:-1], ("c", "d"), ("d", "end")], {})
    assert all(after[name] == before[name] for name in names)


@given(st.text(max_size=200))
def test_any_file_of_positions_can_be_read(text: str) -> None:
    found = positions_in(text)
    assert positions_in(positions_file(found)) == found


def test_what_is_no_position_is_passed_over() -> None:
    text = "watch 8 -16\r\n# note\nallocate 1\nx 1 2 3\n 7 7\nbig 9999999 1\nend\t3 4\nwatch 9 9"
    assert positions_in(text) == {"watch": (9, 9), "end": (3, 4)}
    assert positions_file({"b": (1, 2), "a": (-3, 4)}) == "a -3 4\nb 1 2\n"
