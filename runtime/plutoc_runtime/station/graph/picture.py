"""The app's own graph as a picture: what a page needs to draw it."""

from __future__ import annotations

from .layout import drawn
from .read import Arrow, Box, Graph

_NAME, _KIND, _LABEL = 7.8, 5.8, 5.6
"""How wide a letter is, on average: of a name, of a kind, of the statuses beside an arrow."""
_BORDER = 20.0
_NARROW, _WIDE = 72.0, 210.0
_HIGH = 44.0
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
        _labels(graph),
    )
    return {
        "width": round(laid.width, 1),
        "height": round(laid.height, 1),
        "blocks": [
            {
                "name": box.name,
                "kind": box.kind,
                "doc": box.doc,
                "shape": box.shape,
                "x": round(placed.x, 1),
                "y": round(placed.y, 1),
                "w": round(placed.w, 1),
                "h": round(placed.h, 1),
            }
            for box, placed in zip(graph.boxes, laid.boxes, strict=True)
        ],
        "edges": [
            {
                "from": arrow.source,
                "to": arrow.target,
                "statuses": list(arrow.statuses),
                "fork": arrow.fork,
                "dotted": arrow.dotted,
                "points": [_rounded(point) for point in way],
                "label": _rounded(label) if label is not None else None,
            }
            for arrow, way, label in zip(graph.arrows, laid.ways, laid.labels, strict=True)
        ],
    }


def _rounded(point: tuple[float, float]) -> list[float]:
    return [round(point[0], 1), round(point[1], 1)]


def _size(box: Box) -> tuple[float, float]:
    if not box.kind:
        return _PILL
    text = max(_NAME * len(box.name), _KIND * len(box.kind))
    return min(max(text + _BORDER, _NARROW), _WIDE), _HIGH


def _labels(graph: Graph) -> list[float]:
    """Return how wide the statuses beside each arrow are: none where there is nothing to choose."""
    leaving: dict[str, set[tuple[str, ...]]] = {}
    for arrow in graph.arrows:
        leaving.setdefault(arrow.source, set()).add(arrow.statuses)
    return [_width(arrow) if len(leaving[arrow.source]) > 1 else 0.0 for arrow in graph.arrows]


def _width(arrow: Arrow) -> float:
    return _LABEL * len(", ".join(arrow.statuses))
