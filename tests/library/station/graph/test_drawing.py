"""The picture of a graph: nothing lies over anything else, and every arrow leads where it shall."""

from __future__ import annotations

from itertools import combinations, pairwise

import pytest

from pluto_fleet.station.graph.picture import Arrow, Box, Graph, graph_in, laid_out
from pluto_fleet.station.wire_app import GraphDrawing
from plutoc.check.model import Checked
from plutoc.emit.readme_file import readme
from plutoc.report.pictures import mermaid
from tests.library.station.graph.looking import boxes_of, mistakes, overlap, stands_of, words_of
from tests.library.station.graph.sources import examples, random_graphs


def picture_of(checked: Checked) -> GraphDrawing:
    """Return the picture that a page gets of an app, as the station reads it."""
    graph = graph_in(readme(checked.graph, "app.pluto", mermaid(checked)))
    picture = None if graph is None else laid_out(graph)
    assert picture is not None
    return picture


@pytest.mark.parametrize(("name", "app"), examples().items(), ids=lambda one: str(one)[:30])
def test_an_example_is_drawn_so_that_all_can_be_read(name: str, app: Checked) -> None:
    """No box, word or arrow lies over another, and no arrow ends where missions stand."""
    picture = picture_of(app)
    assert list(mistakes(picture)) == []
    words = words_of(picture)
    assert not any(overlap(one, other) for one, other in combinations(words, 2)), name
    assert not any(overlap(one, box) for one in words for box in boxes_of(picture).values()), name
    ways = [edge["points"] for edge in picture["edges"]]
    ends = [(x, y - 6, x, y + 6) for way in ways for x, y in (way[0], way[-1])]
    assert not any(overlap(stand, end) for stand in stands_of(picture) for end in ends), name
    assert picture["width"] <= 840, name  # as wide as a panel with letters of two thirds


def test_words_stand_where_there_is_something_to_choose() -> None:
    """Where all ways out of a block have the same statuses, nothing is said."""
    edges = picture_of(examples()["alfalfa"])["edges"]
    said = {(one["source"], one["target"]) for one in edges if one["label"] is not None}
    assert {source for source, _ in said} == {"first", "retry", "judge", "again"}
    assert said >= {("first", "allocate"), ("first", "retry"), ("first", "judge")}


def test_every_app_has_a_picture_without_mistakes() -> None:
    """Random graphs, some of them large and tangled."""
    for app in random_graphs(10):
        picture = picture_of(app)
        assert list(mistakes(picture)) == [], app.graph.source.text
        for left, top, right, bottom in words_of(picture):
            assert left >= 0 and top >= -1, app.graph.source.text
            assert right <= picture["width"] and bottom <= picture["height"] + 1


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
    picture = laid_out(chain(100))
    assert picture is not None and list(mistakes(picture)) == []
    assert laid_out(chain(1000)) is None
