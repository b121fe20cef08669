"""The picture of a graph: nothing lies over anything else, and every arrow leads where it shall."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations, pairwise
from typing import Any

import pytest

from pluto_fleet.station.graph.layout import Area, Point
from pluto_fleet.station.graph.picture import Arrow, Box, Graph, graph_in, laid_out
from pluto_fleet.station.wire_app import GraphDrawing
from plutoc.check.model import Checked
from plutoc.emit.readme_file import readme
from plutoc.report.pictures import mermaid
from tests.library.station.graph.test_reading import examples, random_graphs

STAND = 13.0
LETTER = 5.4
"""About as wide as one is."""
ROUNDED = 0.11
"""A page gets numbers that are off by less."""


def boxes_of(picture: Mapping[str, Any]) -> dict[str, Area]:
    """Return what each block covers, by its name."""
    return {
        one["name"]: (one["x"], one["y"], one["x"] + one["w"], one["y"] + one["h"])
        for one in picture["blocks"]
    }


def words_of(picture: Mapping[str, Any]) -> list[Area]:
    """Return what the statuses beside arrows cover, about."""
    found = []
    for one in picture["edges"]:
        if one["label"] is not None:
            (x, y, *_), width = one["label"], LETTER * len(", ".join(one["statuses"]))
            found.append((x - width / 2, y - 9, x + width / 2, y + 2))
    return found


def stands_of(picture: Mapping[str, Any]) -> list[Area]:
    """Return where missions stand: at the foot of each block."""
    middles = [((box[0] + box[2]) / 2, box[3]) for box in boxes_of(picture).values()]
    return [(x - STAND, foot, x + STAND, foot + STAND) for x, foot in middles]


def overlap(one: Area, other: Area) -> bool:
    """Return whether two areas share more than an edge."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def along(one: Area, other: Area) -> bool:
    """Return whether two pieces of ways cannot be told apart for a stretch."""
    width = min(one[2], other[2]) - max(one[0], other[0])
    height = min(one[3], other[3]) - max(one[1], other[1])
    return min(width, height) > -ROUNDED and max(width, height) > 1


def mistakes(picture: Mapping[str, Any]) -> Iterator[str]:
    """Yield what must never be: boxes over boxes, ways through boxes or along each other, loose ends, slants."""
    boxes = boxes_of(picture)
    for (a, one), (b, other) in combinations(boxes.items(), 2):
        if overlap(one, other):
            yield f"{a} lies over {b}"
    pieces: list[tuple[int, Area]] = []
    for number, edge in enumerate(picture["edges"]):
        name = f"the way from {edge['source']} to {edge['target']}"
        ends = (boxes[edge["source"]], edge["points"][0]), (
            boxes[edge["target"]],
            edge["points"][-1],
        )
        if not all(touches(box, end) for box, end in ends):
            yield f"{name} has a loose end"
        for (x, y), (to_x, to_y) in pairwise(edge["points"]):
            piece = min(x, to_x), min(y, to_y), max(x, to_x), max(y, to_y)
            width, height = piece[2] - piece[0], piece[3] - piece[1]
            if min(width, height) >= ROUNDED or max(width, height) == 0:
                yield f"{name} is slanted, or stands still"
            for block, (left, top, right, bottom) in boxes.items():
                within = left + ROUNDED, top + ROUNDED, right - ROUNDED, bottom - ROUNDED
                if overlap(piece, within):
                    yield f"{name} runs through {block}"
            if any(along(piece, other) for its, other in pieces if its != number):
                yield f"{name} lies along another"
            pieces.append((number, piece))
    for left, top, right, bottom in [*boxes.values(), *(piece for _, piece in pieces)]:
        if min(left, top) < 0 or right > picture["width"] or bottom > picture["height"]:
            yield "something lies outside"


def touches(box: Area, point: Point) -> bool:
    """Return whether a point is on the edge of a box, but not in a corner."""
    (left, top, right, bottom), (x, y) = box, point
    on_side = min(abs(x - left), abs(x - right)) < ROUNDED and top < y < bottom
    return on_side or (min(abs(y - top), abs(y - bottom)) < ROUNDED and left < x < right)


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
