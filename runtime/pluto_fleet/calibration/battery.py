"""What flights take of a battery, and how long it takes to charge it, fitted to the telemetry around them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import dist
from typing import TYPE_CHECKING

from ..jobs.flown import BROKEN_OFF, DONE, LAND, TAKE_OFF
from ..shared.domain.motion import charging
from .estimates import Fit, Row, fitted
from .found import SPARE, Calibration, Found, too_few

if TYPE_CHECKING:
    from .commands import Command

TICK, STEP = 1e-4, 1e-5
"""What the seconds and the batteries of a journal are rounded to."""
NEAR, LITTLE = 0.05, 0.01
"""How far off a charge, as a share of it, or a flight, as a share of a battery, is never left out."""
FULL, CHARGED = 0.985, 0.02
"""Shares of a battery: one that is full does not tell when it was; what must have been charged."""
BESIDE = 0.3
"""Metres from where it landed, up to which a drone counts as not carried elsewhere."""


def find_battery(what: Calibration, runs: Sequence[Sequence[Command]]) -> None:
    """Find what a flight takes of a battery, and how long that takes to be charged."""
    flights = [Row((share,), used) for run in runs for share, used in _flights(run)]
    fit = fitted(flights, relative=False, finest=STEP, near=LITTLE)
    _keep(what, "drain", fit, "flight", len(flights))
    charges = [
        Row((expected,), took) for run in runs for expected, took in _charges(run, what.model.taper)
    ]
    fit = fitted(charges, relative=True, finest=TICK, near=NEAR)
    _keep(what, "charge", fit, "charge", len(charges))


def _keep(what: Calibration, name: str, fit: Fit | None, of: str, count: int) -> None:
    """Keep the factor that was fitted, if it was."""
    if fit is None or fit.spread.spare < SPARE:
        what.untold[name] = too_few(count, f"whole {of}", SPARE + 1)
        return
    what.found[name] = Found(estimate=fit.values[0], count=count - fit.left_out, of=of)


def _by_drone(run: Iterable[Command]) -> Iterator[list[Command]]:
    drones: dict[str, list[Command]] = {}
    for one in run:
        drones.setdefault(one.drone, []).append(one)
    yield from drones.values()


def _flights(run: Sequence[Command]) -> Iterator[tuple[float, float]]:
    """Yield of each flight its share of the flight time, hovering to hovering, and what it used."""
    for commands in _by_drone(run):
        rise: Command | None = None
        for one in commands:
            if one.what == TAKE_OFF:
                rise = one if one.ended == DONE else None
            elif one.ended not in (DONE, BROKEN_OFF):
                rise = None
            elif one.what == LAND:
                if rise is not None and one.ended == DONE and rise.flight_time > 0:
                    share = (one.began - rise.ended_at) / rise.flight_time
                    yield share, rise.battery[1] - one.battery[0]
                rise = None


def _charges(run: Sequence[Command], taper: float) -> Iterator[tuple[float, float]]:
    """Yield of each charge how long it should take, and how long it took."""
    for commands in _by_drone(run):
        for down, up in pairwise(commands):
            if (down.what, down.ended, up.what) != (LAND, DONE, TAKE_OFF) or up.charge_time <= 0:
                continue
            level, after = down.battery[1], up.battery[0]
            if after > FULL or after - level < CHARGED or dist(down.end, up.start) > BESIDE:
                continue
            yield charging(level, after, up.charge_time, taper), up.began - down.ended_at
