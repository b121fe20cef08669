"""Where ways leave and enter the sides of boxes, so that no two of them run into one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

from .grid import Grid, Spot
from .ground import Side
from .routes import Route

_STEP = 2.0
_ASIDE = 4.0
"""How far from the middle a way wants to leave that turns to that side."""
_BESIDE, _STAND = 18.0, 14.0
"""The same above and below boxes, and what is left free there: in the middle missions stand."""
_NEAR = (8.0, 6.0)
"""What shall be between two ways, and what must do where there is little room."""
_PASSING = 6.0
"""How far a way can be from the middle that goes on between other boxes: less than `CLEAR`."""
_CORNER = 7.0
"""What is left free of a side at each end."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ports:
    """Of one way: how far from the middle of a box's side it leaves there, and enters there."""

    leaving: float
    entering: float


@dataclass(frozen=True, slots=True)
class _Stub:
    """The piece of a way next to a box. Those in one zone, whose spans meet, must lie apart."""

    zone: tuple[bool, int, int]
    span: tuple[float, float]
    base: float
    """Where the middle of the side is, across."""
    half: float
    wanted: float


_Busy = dict[tuple[bool, int, int], list[tuple[tuple[float, float], float]]]
"""In each zone the spans of stubs, and where they are."""


def ports(grid: Grid, ways: Sequence[tuple[int, int]], found: Sequence[Route]) -> list[Ports]:
    """Return the ports of each way; straight ones choose first, then those that bend least."""
    busy: _Busy = {}
    given: dict[int, Ports] = {}
    for number in sorted(range(len(ways)), key=lambda one: (len(found[one].lines), one)):
        route = found[number]
        source, target = (grid.spots[box] for box in ways[number])
        if not route.lines:
            stub = _straight(source, target, route)
            offset = _placed(stub, busy)
            given[number] = Ports(leaving=offset, entering=offset)
            continue
        offsets = [_placed(stub, busy) for stub in _stubs(source, target, route)]
        given[number] = Ports(leaving=offsets[0], entering=offsets[1])
    return [given[number] for number in range(len(ways))]


def _placed(stub: _Stub, busy: _Busy) -> float:
    """Return how far from the middle a stub shall be: as near to where it wants as others let it."""
    there = busy.setdefault(stub.zone, [])
    steps = int(max(stub.half - _CORNER, 0.0) / _STEP)
    offsets = [_STEP * step for step in range(-steps, steps + 1)]
    middle = 0.0 if stub.zone[0] else _STAND
    offsets.sort(key=lambda one: (abs(one) < middle, abs(one - stub.wanted), abs(one), one))
    low, high = stub.span
    others = [at for span, at in there if span[0] <= high and low <= span[1]]
    room = {one: min((abs(stub.base + one - at) for at in others), default=inf) for one in offsets}
    offset = next(
        (one for near in _NEAR for one in offsets if room[one] >= near),
        max(offsets, key=room.__getitem__),
    )
    there.append((stub.span, stub.base + offset))
    return offset


def _straight(source: Spot, target: Spot, route: Route) -> _Stub:
    if route.leaving.flat:
        low, high = sorted((source.column, target.column))
        return _Stub(
            (True, source.row, 0),
            (low + 1, high),
            source.y,
            _half(min(source.h, target.h), high > low + 1),
            0.0,
        )
    channel = max(source.row, target.row)
    wanted = _BESIDE * (target.row - source.row)
    return _Stub((False, channel, source.column), (0, 0), 0.0, min(source.w, target.w) / 2, wanted)


def _stubs(source: Spot, target: Spot, route: Route) -> Iterator[_Stub]:
    """Yield the two ends of a way that bends."""
    for spot, side, line, other, toward in (
        (source, route.leaving, route.lines[0], target, route.lines[1:2]),
        (target, route.entering, route.lines[-1], source, route.lines[-2:-1]),
    ):
        if side.flat:
            nearest = spot.column + (side is Side.RIGHT)
            low, high = sorted((nearest, line[1]))
            there = (other.row - spot.row, other.y - spot.y)
            ahead = toward[0][1] - 0.5 - spot.row if toward else there[0] or there[1]
            half = _half(spot.h, high > low)
            yield _Stub((True, spot.row, 0), (low, high), spot.y, half, _toward(ahead, _ASIDE))
        else:
            where = toward[0][1] - 0.5 if toward else other.column
            zone = (False, line[1], spot.column)
            yield _Stub(zone, (0, 0), 0.0, spot.w / 2, _toward(where - spot.column, _BESIDE))


def _half(high: float, passing: bool) -> float:
    """Return how much of a side there is for a stub, from the middle."""
    return min(high / 2, _PASSING + _CORNER) if passing else high / 2


def _toward(ahead: float, far: float) -> float:
    return 0.0 if not ahead else far if ahead > 0 else -far
