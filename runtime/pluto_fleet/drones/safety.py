"""Safety monitoring: the drones' events, and checks of each drone ten times a second.

Checked are silence, the permitted area, the battery and unexpected landings. A drone with a low battery,
or outside the permitted area, is landed.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from functools import partial
from math import inf

from ..jobs.landing_sites import free_spot
from ..shared.domain.airspace import Airspace, Polygon, distance, inside, tidy
from ..shared.domain.errors import ANY_ERROR, Failure, FlightFailed
from ..shared.domain.model import Point
from ..shared.domain.text import duration, number, percent, place
from .commands import fly, land
from .protocol import (
    ACTS_BY_ITSELF,
    BATTERY_LOW,
    CRASHED,
    LINK_LOST,
    LOCKED,
    POSITION_LOST,
    DroneEvent,
)
from .timeouts import Lag, shortened
from .vehicle import LAND, RISE, Vehicle

TOLERANCE = 0.3
"""Metres of tolerance at least: positions are inexact, and a stopped drone overshoots."""
_ERRORS = 2.0
"""The tolerance as a multiple of how far a drone is usually off."""


def outside_area(airspace: Airspace, point: Point, error: float = TOLERANCE) -> str | None:
    """Return where a drone is that has left the permitted area, or None; `error`: by how much its position may be off."""
    (x, y, z), (width, depth) = point, airspace.size
    if not (-error <= x <= width + error and -error <= y <= depth + error):
        return f"{place(point)}, which is outside the map"
    if z > airspace.ceiling + error:
        return f"{place(point)}, {number(z)} m high"
    if z < -error:
        return f"{place(point)}, {number(-z)} m below the ground"
    for count, corners in enumerate(airspace.no_fly, 1):
        if is_deep_inside((x, y), tidy(corners), error):
            return f"{place(point)}, which is inside no-fly area {count}"
    return None


def is_over_no_fly(airspace: Airspace, point: Point) -> bool:
    """Return whether a drone there must not land straight down."""
    areas = (tidy(corners) for corners in airspace.no_fly)
    return any(len(area) > 2 and inside(point[:2], area) for area in areas)


def is_deep_inside(point: tuple[float, float], area: Polygon, error: float = TOLERANCE) -> bool:
    """Return whether a point is further inside than the tolerance, or halfway into a narrow area."""
    if len(area) < 3 or not inside(point, area):
        return False
    edges = list(zip(area, area[1:] + area[:1], strict=True))
    around = sum(distance(a, b, b) for a, b in edges)
    twice = abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in edges))
    # The widest circle in an area is about as wide as twice its surface by its outline.
    within = min(error, twice / 2 / around)
    return all(distance(point, a, b) > within for a, b in edges)


_BETWEEN_LANDINGS = 1.0
"""Seconds until a landing is tried again."""
_CLEARANCE = 0.5
"""Metres from other drones at which one lands that may not land below, besides what its position may be off."""


async def land_by_itself(vehicle: Vehicle, airspace: Airspace, others: Sequence[Point]) -> None:
    """Land a drone here; over a no-fly area it first flies out of it by the shortest way.

    One that has lost its position stops, and lands.
    """
    try:
        await vehicle.does(LAND, _down, airspace, others)
    except FlightFailed as error:
        vehicle.calls.say(f"{vehicle.id} was to land: {error}")
        await asyncio.sleep(_BETWEEN_LANDINGS)


async def _down(vehicle: Vehicle, airspace: Airspace, others: Sequence[Point]) -> None:
    here = vehicle.telemetry.location
    if vehicle.position_lost:
        await vehicle.hover()
    elif is_over_no_fly(airspace, here):
        clearance = _CLEARANCE + _ERRORS * vehicle.drone.category.motion.slack
        x, y, _ = free_spot(airspace, here, others, clearance)
        try:
            await fly(vehicle, (x, y, min(max(here[2], _CLEARANCE), airspace.ceiling)))
        except FlightFailed as error:
            vehicle.calls.say(f"{vehicle.id} was to leave the no-fly area: {error}")
    await land(vehicle)


BETWEEN_EVENTS = 0.01
"""Seconds between two events: an endless stream of them would block the loop."""


async def follow_events(vehicle: Vehicle) -> None:
    """Handle all events of a drone, until it is closed."""
    calls = vehicle.calls
    try:
        events = vehicle.navigation.events().__aiter__()
        while True:
            event = await calls.timed(events.__anext__())
            calls.ask("events", partial(handle_event, vehicle, event), None)
            await asyncio.sleep(BETWEEN_EVENTS)
    except StopAsyncIteration:
        pass
    except (asyncio.CancelledError, KeyboardInterrupt):
        raise
    except ANY_ERROR as error:
        calls.mistake("events", error)


def handle_event(vehicle: Vehicle, event: DroneEvent) -> None:
    kind, reason = str(event.kind), shortened(str(event.reason))
    who, where = vehicle.id, place(vehicle.telemetry.location)
    if kind == LINK_LOST:
        vehicle.lost(reason)
    elif kind in (CRASHED, LOCKED) and vehicle.flew_lately and not vehicle.has_crashed:
        vehicle.crashed(f"{who} {_HAS[kind]} at {where}: {reason}")
    elif kind == BATTERY_LOW and not vehicle.telemetry.landed and not vehicle.must_land:
        why = f"the battery of {who} is low at {where}, where it lands: {reason}"
        vehicle.force_landing(FlightFailed(Failure.BATTERY, why))
    elif kind == ACTS_BY_ITSELF and not vehicle.telemetry.landed and not vehicle.must_land:
        # its navigation orders nothing any more, and waits until it has landed
        why = f"{who} acts by itself at {where}: {reason}"
        vehicle.force_landing(FlightFailed(Failure.REFUSED, why), needs_person=False)
    elif kind == POSITION_LOST and not vehicle.telemetry.landed:
        vehicle.lose_position(reason)
    else:
        vehicle.calls.note(f"{who}: {shortened(kind)}: {reason}")


_HAS = {CRASHED: "crashed", LOCKED: "was locked"}


EACH = 0.1
"""The interval of the checks, in seconds."""
ON_GROUND = 3.0
"""Seconds after which a silent drone on the ground has lost its link, if it may not be silent for longer in the air."""
EMPTY, LOW_FOR = 0.03, 3.0
"""A battery is empty when its level was at most this for this many seconds."""
FALLEN_FOR = 1.0
"""Seconds on the ground during a flight after which a drone counts as fallen."""
LATE = 0.3
"""Seconds of delay of a check after which it is logged: drones are not monitored meanwhile."""


class SafetyMonitor:
    """Monitors all drones of the team."""

    def __init__(
        self,
        airspace: Airspace,
        say: Callable[[str], object],
        clock: Callable[[], float],
        silence: float,
    ) -> None:
        """`silence`: seconds for which a drone in the air may tell nothing."""
        self._silence = silence
        self._lag = Lag()
        self._vehicles: list[Vehicle] = []
        self._airspace, self._say, self._clock = airspace, say, clock
        self._low_since: dict[str, float] = {}
        self._fallen_since: dict[str, float] = {}
        self._landings: dict[str, asyncio.Task[None]] = {}

    def watch(self, vehicle: Vehicle) -> None:
        """Check this drone from now on."""
        self._vehicles.append(vehicle)
        vehicle.telemetry.lag = self._lag
        self._low_since[vehicle.id] = self._fallen_since[vehicle.id] = inf

    def hear(self, late: float) -> None:
        """Check all drones; `late`: the delay in seconds."""
        now = self._clock()
        self._lag.called(now, now + EACH)
        if late > LATE:
            self._say(f"the gateway was kept from watching its drones for {duration(late)}")
        for vehicle in self._vehicles:
            self.look(vehicle)

    def stop(self) -> list[asyncio.Task[None]]:
        """Start no further landings; return the tasks that are ending."""
        landings = list(self._landings.values())
        for task in landings:
            task.cancel()
        return landings

    def look(self, vehicle: Vehicle) -> None:
        telemetry = vehicle.telemetry
        if not vehicle.linked:
            return
        landed, busy = telemetry.landed, vehicle.commands.doing
        on_ground = landed and not busy
        if telemetry.silence > (max(ON_GROUND, self._silence) if on_ground else self._silence):
            vehicle.lost(f"it has told nothing for {duration(telemetry.silence)}")
        elif landed:
            self._stands(vehicle, busy)
        elif vehicle.must_land:
            self._bring_down(vehicle)
        else:
            self._flies(vehicle)

    def _stands(self, vehicle: Vehicle, busy: str) -> None:
        where = place(vehicle.telemetry.location)
        self._low_since[vehicle.id] = inf
        if vehicle.must_land:
            vehicle.must_land = False
            self._say(f"{vehicle.id} has landed at {where}")
        elif busy in ("", LAND, RISE):
            self._fallen_since[vehicle.id] = inf
        elif self._lasts(self._fallen_since, vehicle, FALLEN_FOR):
            why = f"{vehicle.id} is on the ground at {where}: it fell, or was switched off"
            vehicle.crashed(why)

    def _flies(self, vehicle: Vehicle) -> None:
        telemetry = vehicle.telemetry
        self._fallen_since[vehicle.id] = inf
        error = max(TOLERANCE, _ERRORS * vehicle.drone.category.motion.slack)
        where = outside_area(self._airspace, telemetry.location, error)
        if where is not None:
            why = f"{vehicle.id} left the permitted area at {where}: it lands"
            vehicle.force_landing(FlightFailed(Failure.REFUSED, why))
        elif (blind := vehicle.position_problem()) is not None:
            vehicle.lose_position(blind)
        elif telemetry.battery_level > EMPTY:
            self._low_since[vehicle.id] = inf
        elif self._lasts(self._low_since, vehicle, LOW_FOR):
            left = percent(telemetry.battery_level)
            why = f"{vehicle.id} has {left} in its battery: it lands at {place(telemetry.location)}"
            vehicle.force_landing(FlightFailed(Failure.BATTERY, why))

    def _lasts(self, since: dict[str, float], vehicle: Vehicle, seconds: float) -> bool:
        """Return whether a present condition has lasted long enough."""
        now = self._clock()
        since[vehicle.id] = min(since[vehicle.id], now)
        return now - since[vehicle.id] >= seconds

    def _bring_down(self, vehicle: Vehicle) -> None:
        """Land a drone, and retry until it has landed."""
        task = self._landings.get(vehicle.id)
        if task is None or task.done():
            others = [other.telemetry.location for other in self._vehicles if other is not vehicle]
            self._landings[vehicle.id] = asyncio.ensure_future(
                land_by_itself(vehicle, self._airspace, others)
            )
