"""The picture of a graph: nothing lies over anything else, and every arrow leads where it shall."""

from __future__ import annotations

from itertools import combinations, pairwise

import pytest

from pluto_fleet.station.graph.picture import Arrow, Box, Graph, graph_in, laid_out
from plutoc.check.model import Checked
from plutoc.emit.readme_file import readme
from plutoc.report.pictures import mermaid
from tests.library.station.graph.looking import (
    Pictured,
    lying_together,
    mistakes,
    overlap,
    pictured,
)
from tests.library.station.graph.sources import examples, random_graphs


def graph_of(checked: Checked) -> Graph:
    """Return the graph as the station reads it."""
    found = graph_in(readme(checked.graph, "app.pluto", mermaid(checked)))
    assert found is not None
    return found


def picture_of(graph: Graph) -> Pictured:
    """Return the picture that a page gets."""
    picture = laid_out(graph)
    assert picture is not None
    return pictured(picture)


@pytest.mark.parametrize(("name", "app"), examples().items(), ids=lambda one: str(one)[:30])
def test_an_example_is_drawn_so_that_all_can_be_read(name: str, app: Checked) -> None:
    """No box, word or arrow lies over another, and no arrow ends where missions stand."""
    picture = picture_of(graph_of(app))
    assert list(mistakes(picture.laid, picture.ways)) == []
    assert list(lying_together(picture.laid)) == []
    assert not any(overlap(one, other) for one, other in combinations(picture.words, 2)), name
    assert not any(overlap(one, box) for one in picture.words for box in picture.laid.boxes), name
    ends = [(x, y - 6, x, y + 6) for way in picture.laid.ways for x, y in (way[0], way[-1])]
    assert not any(overlap(stand, end) for stand in picture.stands for end in ends), name
    assert picture.laid.width <= 840, name  # as wide as a panel with letters of two thirds


def test_words_stand_where_there_is_something_to_choose() -> None:
    """Where all ways out of a block have the same statuses, nothing is said."""
    picture = laid_out(graph_of(examples()["alfalfa"]))
    assert picture is not None
    edges = picture["edges"]
    assert isinstance(edges, list)
    said = {(one["source"], one["target"]) for one in edges if one["label"] is not None}
    assert said == {
        ("first", "allocate"),
        ("first", "retry"),
        ("first", "judge"),
        ("retry", "allocate"),
        ("retry", "end"),
        ("judge", "allocate"),
        ("judge", "again"),
        ("judge", "end"),
        ("again", "wait"),
        ("again", "end"),
    }


def test_every_app_has_a_picture_without_mistakes() -> None:
    """Random graphs, some of them large and tangled."""
    for app in random_graphs(10):
        picture = picture_of(graph_of(app))
        assert list(mistakes(picture.laid, picture.ways)) == [], app.graph.source.text
        assert list(lying_together(picture.laid)) == [], app.graph.source.text
        for left, top, right, bottom in picture.words:
            assert left >= 0 and top >= -1, app.graph.source.text
            assert right <= picture.laid.width and bottom <= picture.laid.height + 1


def chain(many: int) -> Graph:
    """Return a graph of one block after the other, each with a way back to the one before it."""
    names = ["start", *(f"block_{number}" for number in range(many)), "end"]
    return Graph(
        boxes=tuple(Box(name=name, kind=name.title(), doc="", shape="block") for name in names),
        arrows=tuple(
            Arrow(source=one, target=other, statuses=("STANDBY",), fork=False, dotted=False)
            for a, b in pairwise(names)
            for one, other in ((a, b), (b, a))
        ),
    )


def test_a_hundred_blocks_are_drawn_and_a_thousand_are_not() -> None:
    """Of so many nothing could be seen, and all would wait for them."""
    assert not list(mistakes((picture := picture_of(chain(100))).laid, picture.ways))
    assert laid_out(chain(1000)) is None
