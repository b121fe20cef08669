"""Where ways leave and enter the sides of boxes, so that no two of them run into one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .grid import Grid, Spot
from .ground import Side
from .routes import Route

_STEP = 5.0
_NEAR = 7.0
"""Less than this between two ways is too little."""
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


def ports(grid: Grid, ways: Sequence[tuple[int, int]], found: Sequence[Route]) -> list[Ports]:
    """Return the ports of each way; straight ones choose first, then those that bend least."""
    busy: dict[tuple[bool, int, int], list[tuple[tuple[float, float], float]]] = {}
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


def _placed(
    stub: _Stub, busy: dict[tuple[bool, int, int], list[tuple[tuple[float, float], float]]]
) -> float:
    """Return how far from the middle a stub shall be: as near to where it wants as others let it."""
    there = busy.setdefault(stub.zone, [])
    most = max(stub.half - _CORNER, 0.0)
    steps = int(most / _STEP)
    offsets = [_STEP * step for step in range(-steps, steps + 1)]
    offsets.sort(key=lambda one: (abs(one - stub.wanted), abs(one), one))
    others = [at for span, at in there if span[0] <= stub.span[1] and stub.span[0] <= span[1]]
    room = {
        one: min((abs(stub.base + one - at) for at in others), default=_NEAR) for one in offsets
    }
    free = [one for one in offsets if room[one] >= _NEAR]
    offset = free[0] if free else max(offsets, key=room.__getitem__)
    there.append((stub.span, stub.base + offset))
    return offset


def _straight(source: Spot, target: Spot, route: Route) -> _Stub:
    if route.leaving.flat:
        low, high = sorted((source.column, target.column))
        return _Stub(
            (True, source.row, 0),
            (low + 1, high),
            source.y,
            min(source.h, target.h) / 2,
            0.0,
        )
    channel = max(source.row, target.row)
    return _Stub((False, channel, source.column), (0, 0), 0.0, min(source.w, target.w) / 2, 0.0)


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
            yield _Stub((True, spot.row, 0), (low, high), spot.y, spot.h / 2, _toward(ahead))
        else:
            where = toward[0][1] - 0.5 if toward else other.column
            zone = (False, line[1], spot.column)
            yield _Stub(zone, (0, 0), 0.0, spot.w / 2, _toward(where - spot.column) * 2)


def _toward(distance: float) -> float:
    return 0.0 if not distance else _STEP if distance > 0 else -_STEP
