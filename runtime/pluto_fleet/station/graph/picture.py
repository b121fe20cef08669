"""The app's own graph as a picture: what a page needs to draw it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

from .layout import drawn
from .read import Box, Graph

_NAME, _KIND, _LABEL = 8.2, 6.0, 6.2
"""How wide a letter is, on average: of a name, of a kind, of the statuses beside an arrow."""
_BORDER, _NARROW, _WIDE, _HIGH = 20.0, 72.0, 210.0, 44.0
_PILL = (62.0, 32.0)
_MOST = 400
"""Of more boxes nobody would see anything."""


def laid_out(graph: Graph) -> dict[str, object] | None:
    """Return the picture as plain data; None where it would be too large to be of use."""
    if len(graph.boxes) > _MOST:
        return None
    number = {box.name: place for place, box in enumerate(graph.boxes)}
    laid = drawn(
        [_size(box) for box in graph.boxes],
        [(number[arrow.source], number[arrow.target]) for arrow in graph.arrows],
        _widths(graph),
    )
    blocks = []
    for box, (x, y, right, bottom) in zip(graph.boxes, laid.boxes, strict=True):
        corner, size = _rounded((x, y)), _rounded((right - x, bottom - y))
        blocks.append({**asdict(box), **dict(zip("xywh", corner + size, strict=True))})
    edges = [
        {
            "from": arrow.source,
            "to": arrow.target,
            "statuses": list(arrow.statuses),
            "fork": arrow.fork,
            "dotted": arrow.dotted,
            "points": [_rounded(point) for point in way],
            "label": _rounded(words) if words else None,
        }
        for arrow, way, words in zip(graph.arrows, laid.ways, laid.words, strict=True)
    ]
    width, height = _rounded((laid.width, laid.height))
    return {"width": width, "height": height, "blocks": blocks, "edges": edges}


def _rounded(numbers: Sequence[float]) -> list[float]:
    return [round(number, 1) for number in numbers]


def _size(box: Box) -> tuple[float, float]:
    if not box.kind:
        return _PILL
    text = max(_NAME * len(box.name), _KIND * len(box.kind))
    return min(max(text + _BORDER, _NARROW), _WIDE), _HIGH


def _widths(graph: Graph) -> list[float]:
    """Return how wide the statuses beside each arrow are: none where there is nothing to choose."""
    leaving: dict[str, set[tuple[str, ...]]] = {}
    for arrow in graph.arrows:
        leaving.setdefault(arrow.source, set()).add(arrow.statuses)
    return [
        _LABEL * len(", ".join(arrow.statuses)) if len(leaving[arrow.source]) > 1 else 0.0
        for arrow in graph.arrows
    ]
