"""From boxes and arrows to a picture: places, and the points of every arrow."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from .grid import Frame, Grid, Line, Point, Room, Side, folded, framed
from .layers import layers
from .ports import ports
from .routes import Route, routes
from .tracks import tracks
from .words import Area, words

_WIDE, _HIGH = 560.0, 400.0
"""The panel that the picture shall fit into without being made smaller."""
_MOST_ROWS, _TRIED, _MANY = 12, 3, 40
"""So many numbers of rows are thought of, so many tried; of so many boxes, only one."""
_TURN = 0.12
"""What a turn from row to row adds to what is paid for a picture."""
_MARGIN, _APART, _ROOM, _ROOM_BELOW, _AIR = 10.0, 8.0, 16.0, 24.0, 10.0
"""Around the picture; between two ways; between a box and a way along it, where an arrow's head must have
its place; the same below a box, where missions stand; beside words."""
_FAR = 1e5
"""Further than any picture reaches."""
_ABOUT_GAP, _ABOUT_CHANNEL = (20.0, 20.0), (22.0, 22.0)
"""The room that a gap and a channel will have, more or less."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Laid:
    """A picture, in the order of what was given."""

    width: float
    height: float
    boxes: tuple[Area, ...]
    ways: tuple[tuple[Point, ...], ...]
    words: tuple[Point | None, ...]
    """The middle of the foot of each arrow's words."""


def drawn(
    sizes: Sequence[tuple[float, float]], ways: Sequence[tuple[int, int]], widths: Sequence[float]
) -> Laid:
    """Return the picture of boxes of these sizes, the first of which is where all begins.

    `widths` says how wide the words of each way are; 0 where it has none.
    """
    found = layers(len(sizes), ways)
    grids = [folded(found, sizes, rows) for rows in range(1, min(_MOST_ROWS, len(found)) + 1)]
    grids.sort(key=lambda grid: -_fit(_about(grid)))
    tries: list[tuple[float, int, Grid, list[Route]]] = []
    for place, grid in enumerate(grids[: 1 if len(sizes) > _MANY else _TRIED]):
        about = _about(grid)
        chosen, paid = routes(grid, ways, about)
        tries.append((paid * (1 + _TURN * len(grid.rows)) / _fit(about), place, grid, chosen))
    _, _, grid, chosen = min(tries, key=lambda one: one[:2])
    return _laid(grid, chosen, widths)


def _about(grid: Grid) -> Frame:
    return framed(
        grid, [_ABOUT_GAP] * (len(grid.columns) + 1), [_ABOUT_CHANNEL] * (len(grid.rows) + 1)
    )


def _fit(frame: Frame) -> float:
    """Return how large a picture can be shown in the panel."""
    return min(1.0, _WIDE / frame.width, _HIGH / frame.height)


def _laid(grid: Grid, chosen: Sequence[Route], widths: Sequence[float]) -> Laid:
    doors = ports(chosen)
    track = tracks(chosen, doors)
    gaps, channels = _rooms(
        grid, chosen, widths, {one: max(there.values()) for one, there in track.items()}
    )
    frame = framed(grid, gaps, channels)
    boxes = []
    for spot in grid.spots:
        left, _ = frame.door(spot, Side.LEFT)
        x, top = frame.door(spot, Side.TOP)
        boxes.append((left, top, 2 * x - left, top + spot.h))
    ways = [
        tuple(
            _corners(
                route.points(frame, door, [_APART * track[one][number] for one in route.lines])
            )
        )
        for number, (route, door) in enumerate(zip(chosen, doors, strict=True))
    ]
    return Laid(
        width=frame.width,
        height=frame.height,
        boxes=tuple(boxes),
        ways=tuple(ways),
        words=tuple(words(ways, widths, [*boxes, *_outside(frame)])),
    )


def _outside(frame: Frame) -> list[Area]:
    """Return what is around the picture."""
    right, bottom = frame.width, frame.height
    return [
        (-_FAR, -_FAR, _FAR, 0.0),
        (-_FAR, -_FAR, 0.0, _FAR),
        (right, -_FAR, _FAR, _FAR),
        (-_FAR, bottom, _FAR, _FAR),
    ]


def _rooms(
    grid: Grid, chosen: Sequence[Route], widths: Sequence[float], last: dict[Line, int]
) -> tuple[list[Room], list[Room]]:
    """Return the room of each gap and each channel: for tracks, and in gaps for words, too."""
    before, after = ([0.0] * (len(grid.columns) + 1) for _ in range(2))
    for route, width in zip(chosen, widths, strict=True):
        if width and route.leaving.value[0] and len(route.lines) < 2:
            right = route.leaving is Side.RIGHT
            gap = route.source.column + right
            need = width + _AIR if route.lines else (width + _AIR) / 2
            if right or not route.lines:
                before[gap] = max(before[gap], need)
            if not right or not route.lines:
                after[gap] = max(after[gap], need)
    gaps = [
        _room(
            last.get((True, number)),
            number,
            len(grid.columns),
            max(_ROOM, words_before),
            max(_ROOM, behind),
        )
        for number, (words_before, behind) in enumerate(zip(before, after, strict=True))
    ]
    channels = [
        _room(last.get((False, number)), number, len(grid.rows), _ROOM_BELOW, _ROOM)
        for number in range(len(grid.rows) + 1)
    ]
    return gaps, channels


def _room(last: int | None, number: int, end: int, before: float, after: float) -> Room:
    """Return the room of a gap or a channel; those around everything need less."""
    tracks_wide = _APART * (last or 0)
    if number == 0:
        return _MARGIN, tracks_wide + (after if last is not None else 0.0)
    if number == end:
        return before, tracks_wide + _MARGIN if last is not None else 0.0
    return before, tracks_wide + after


def _corners(points: Iterable[Point]) -> Iterator[Point]:
    """Yield the points at which a way begins, turns and ends."""
    apart = [point for point, before in pairwise([*points, (-1.0, -1.0)]) if point != before]
    yield apart[0]
    for (a, b), (_, c) in pairwise(pairwise(apart)):
        if not (a[0] == b[0] == c[0] or a[1] == b[1] == c[1]):
            yield b
    yield apart[-1]
