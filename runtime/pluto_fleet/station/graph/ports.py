"""Where ways leave and enter the sides of boxes, so that no two of them run into one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf

from .grid import Line, Spot
from .routes import Route

_STEP = 2.0
_NEAR = (8.0, 6.0)
"""What shall be between two ways, and what must do where there is little room."""
_CORNER = 7.0
"""What is left free of a side at each end."""
_ASIDE, _BESIDE, _STAND = 4.0, 18.0, 14.0
"""How far from the middle of a side a way wants to be that turns to one side; the same above and below
boxes; and what is left free there, where missions stand."""

Zone = tuple[Line, int]
"""Where two ends of ways can lie over each other: a line, at a row or a column."""
Stub = tuple[Zone, float, float, float]
"""An end of a way: its zone, where the middle of its side is there, how far from that it can be, and how
far it wants to be."""


def ports(found: Sequence[Route]) -> list[tuple[float, float]]:
    """Return how far from the middles of sides each way leaves and enters; simple ones choose first."""
    busy: dict[Zone, list[float]] = {}
    given: dict[int, tuple[float, float]] = {}
    for number in sorted(range(len(found)), key=lambda one: len(found[one].lines)):
        offsets = [_placed(stub, busy) for stub in _stubs(found[number])]
        given[number] = offsets[0], offsets[-1]
    return [given[number] for number in range(len(found))]


def _placed(stub: Stub, busy: dict[Zone, list[float]]) -> float:
    """Return the place of an end: as near to where it wants to be as others let it."""
    zone, base, most, wanted = stub
    steps = int(most / _STEP)
    offsets = [_STEP * step for step in range(-steps, steps + 1)]
    middle = 0.0 if zone[0][0] else _STAND
    offsets.sort(key=lambda one: (abs(one) < middle, abs(one - wanted), abs(one)))
    there = busy.setdefault(zone, [])
    room = {one: min((abs(base + one - at) for at in there), default=inf) for one in offsets}
    free = [one for near in _NEAR for one in offsets if room[one] >= near]
    offset = free[0] if free else max(offsets, key=room.__getitem__)
    there.append(base + offset)
    return offset


def _stubs(route: Route) -> Iterator[Stub]:
    """Yield the ends of a way: one where it is straight, else two."""
    source, target = route.source, route.target
    if not route.lines:
        across = route.leaving.value[0]
        line = (
            (True, max(source.column, target.column))
            if across
            else (False, max(source.row, target.row))
        )
        narrow = min(source, target, key=lambda one: one.h if across else one.w)
        yield _stub(line, narrow, 0.0 if across else _BESIDE * (target.row - source.row))
        return
    for spot, lines, other in (
        (source, route.lines, target),
        (target, route.lines[::-1], source),
    ):
        line = lines[0]
        here, there = (spot.row, other.row) if line[0] else (spot.column, other.column)
        ahead = (lines[1][1] - 0.5 if len(lines) > 1 else there) - here
        ahead = ahead or (other.y - spot.y if line[0] else 0.0)
        far = _ASIDE if line[0] else _BESIDE
        yield _stub(line, spot, 0.0 if not ahead else far if ahead > 0 else -far)


def _stub(line: Line, spot: Spot, wanted: float) -> Stub:
    if line[0]:
        return (line, spot.row), spot.y, spot.h / 2 - _CORNER, wanted
    return (line, spot.column), 0.0, spot.w / 2 - _CORNER, wanted
