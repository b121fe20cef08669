"""The navigation of a Crazyflie: the public protocol, implemented with cflib."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from math import inf

from ..drones.battery_gauge import BatteryGauge
from ..drones.protocol import (
    LINK_LOST,
    ActionNotDone,
    DroneEvent,
    DroneSetup,
    DroneTelemetry,
    LinkLost,
    NavigationError,
    NotReady,
    Rejected,
)
from ..files.addresses import address_of
from ..shared.domain.actions import MEASURE, PHOTO, Plain
from ..shared.domain.model import Item, Photo, Point, Sighting
from ..shared.domain.text import quoted
from . import (
    actions,
    commander,
    connection,
    flying,
    logs,
    messages,
    parameters,
    preflight,
)
from .commander import stop_motors
from .connection import open_session, scan
from .following import follow
from .options import options_of
from .preflight import firmware_facts
from .session import CrazyflieSession
from .state import LOW_POWER, AlarmDetector, State

_AWAY = 4.0
"""The time-out of closing links, in seconds."""
_LANDING = 0.3
"""The default speed of a landing, in metres per second."""


class Crazyflie:
    """One Crazyflie, reached through cflib by radio or, a simulated one, by UDP."""

    def __init__(self, setup: DroneSetup) -> None:
        self._setup, self._id = setup, setup.id
        self._options = options_of(setup.options)
        self._session: CrazyflieSession | None = None
        self._readings: logs.LogReader | None = None
        cells = self._options.cells
        self._battery, self._alarms = BatteryGauge(cells), AlarmDetector(cells)
        self._state: State | None = None
        self._events: asyncio.Queue[DroneEvent | None] = asyncio.Queue()
        self._commanded = False
        """Whether it may fly by a command of an earlier link."""
        self._opening: asyncio.Task[None] | None = None
        self._leaving: set[asyncio.Future[None]] = set()
        self._closed = False

    # The link

    async def connect(self) -> None:
        """Connect or reconnect; an earlier link is closed first.

        The first time is slow, as all tables are read, and slower with many others on the air. After
        a time-out, the next attempt continues with the tables read so far.
        """
        uri = self._setup.uri
        if uri is None:
            raise NotReady(
                f"{self._id} has no uri in the fleet file: it says how to reach a Crazyflie"
            )
        try:
            address_of(uri)
        except ValueError as error:
            raise NotReady(f"{self._id}: uri {quoted(uri)} {error}") from error
        if self._session is not None and self._session.alive:
            return
        if self._opening is None or self._opening.done():
            self._opening = asyncio.create_task(self._open(uri), name=f"connecting to {self._id}")
            self._opening.add_done_callback(_heard)
        await asyncio.shield(self._opening)

    async def _open(self, uri: str) -> None:
        if self._session is not None:
            self._commanded = self._session.commanded
            self._session.release()
            self._session = None
        await self._left()  # two links to one drone would steal each other's packets
        setup = self._setup
        session = await open_session(self._id, uri, setup.folder, self, setup.silence)
        session.commanded = self._commanded
        if not self._options.starts_at_home:  # it only knows its relative movement
            session.lost_beyond = self._options.lost_beyond
        self._session, self._readings = session, logs.LogReader(session)
        if self._options.starts_at_home:
            await connection.set_initial_position(session, self._setup.home)

    async def close(self) -> None:
        """Close the link. If it flies by a command of this object and is reachable, it is landed first.

        An unreachable drone, or one launched by another program, hovers on: the link ends without a
        command.
        """
        if self._opening is not None:
            self._opening.cancel()
            await asyncio.wait({self._opening})
        session = self._session
        if session is not None:
            if session.commanded and session.alive:
                with suppress(NavigationError):
                    await flying.land(session, _LANDING)
            self._session = None
            session.release()
        await self._left()
        if not self._closed:
            self._closed = True
            self._events.put_nowait(None)

    def told(self, state: State) -> None:
        self._state = state
        is_low = state.power == LOW_POWER
        self._battery.hear(state.time, state.volts, flies=state.flies, is_low=is_low)
        for event in self._alarms.hear(state):
            self._events.put_nowait(event)

    def doubted(self, variance: float) -> None:
        adrift = self._session is not None and self._session.adrift
        for event in self._alarms.hear_of_its_place(adrift, variance):
            self._events.put_nowait(event)

    def gone(self, why: str) -> None:
        self._events.put_nowait(DroneEvent(kind=LINK_LOST, reason=why))

    def releasing(self, gone: asyncio.Future[None]) -> None:
        self._leaving = {one for one in self._leaving if not one.done()} | {gone}

    async def _left(self) -> None:
        """Wait until all its links are closed, as far as cflib closes them."""
        if self._leaving:
            await asyncio.wait(self._leaving, timeout=_AWAY)

    @property
    def telemetry(self) -> DroneTelemetry:
        state = self._state
        return DroneTelemetry(
            time=-inf if state is None else state.time,
            position=self._setup.home if state is None else state.position,
            yaw=0.0 if state is None else state.yaw,
            voltage=0.0 if state is None else state.volts,
            battery_level=self._battery.level,
            flying=state is not None and state.flies,
        )

    async def events(self) -> AsyncIterator[DroneEvent]:
        while (event := await self._events.get()) is not None:
            yield event

    def _linked(self) -> CrazyflieSession:
        """Return the session; raise `LinkLost` if there is none, or if it is silent."""
        if self._session is None:
            raise LinkLost(messages.not_connected(self._id))
        self._session.now()
        return self._session

    # Flying

    async def preflight(self) -> Sequence[str]:
        try:
            return await self._problems(self._linked())
        except LinkLost as error:
            return [str(error)]

    async def _problems(self, session: CrazyflieSession) -> list[str]:
        return await preflight.problems(session, self._battery, self._options, self._setup.speed)

    async def takeoff(self, height: float, speed: float) -> None:
        """Take off straight up to this height; one that flies already goes there from where it is."""
        session = self._linked()
        state = session.well()
        target = (state.position[0], state.position[1], height)
        flying.check(self._id, target, speed)
        if state.steered:
            await flying.go_to(session, target, speed)
            return
        reasons = await self._problems(session)
        if reasons:
            raise NotReady(f"{self._id} is not ready: {'; '.join(reasons)}")
        await flying.takeoff(session, height, speed)

    async def go_to(self, target: Point, speed: float) -> None:
        flying.check(self._id, target, speed)
        await flying.go_to(self._linked(), target, speed)

    async def follow(self, target: Point, speed: float, seconds: float) -> None:
        flying.check(self._id, target, speed)
        await follow(self._linked(), target, speed, seconds)

    async def hold(self) -> None:
        await flying.hold(self._linked())

    async def land(self, speed: float) -> None:
        flying.check_speed(self._id, speed)
        await flying.land(self._linked(), speed)

    async def emergency_stop(self) -> None:
        if self._session is None:
            raise LinkLost(messages.not_connected(self._id))
        await stop_motors(self._session)

    # Optional abilities

    def why_not(self, action: str, parameters: Mapping[str, Plain]) -> str | None:
        return actions.why_not(self._id, self._options, self._session, action, parameters)

    async def act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        session, folder = self._linked(), self._setup.folder
        value = await actions.act(
            session, self._reader(), self._options, folder, action, parameters
        )
        if not isinstance(value, Photo):
            return value
        tracks = self._setup.in_view(value.position, value.width, value.height)
        return replace(value, tracks=tracks, sees=tuple(sorted(one.kind for one in tracks)))

    async def trigger(self, action: str, parameters: Mapping[str, Plain]) -> object:
        """Do an action on the way, by what it measures or its camera sees."""
        if action not in (MEASURE, PHOTO):
            raise ActionNotDone(f"{self._id} must stop to {action}")
        return await self.act(action, parameters, None)

    async def sees(self) -> Sequence[Sighting]:
        """Return what the fleet's tracker sees in the view of its camera, which sees no more by itself."""
        reason = self.why_not(PHOTO, {})
        if reason is not None:
            raise ActionNotDone(reason)
        place = self._linked().now().position
        return self._setup.in_view(place, *actions.ground(self._options, place[2]))

    async def read(self, name: str) -> float:
        """Return a log variable, a parameter, or else a quantity, by the variable that the fleet file names for it."""
        session = self._linked()
        if not logs.has(session.cf, name) and parameters.element_of(session.cf, name) is not None:
            return await parameters.read(session, name)
        variable = name if logs.has(session.cf, name) else self._options.variable_of(name)
        if variable is None or not logs.has(session.cf, variable):
            said = f"{self._id} has neither a log variable nor a parameter {quoted(name)}"
            if "." not in name:
                said += (
                    "; what a quantity is read from, the fleet file says:"
                    f' measure = {{ {name} = "group.name" }}'
                )
            raise Rejected(said)
        return await self._reader().mean(variable, 0.0)

    async def write(self, name: str, value: float) -> None:
        await parameters.write(self._linked(), name, value)

    def _reader(self) -> logs.LogReader:
        if self._readings is None:
            raise LinkLost(messages.not_connected(self._id))
        return self._readings

    async def locate(self, position: Point) -> None:
        """Send it its position as measured from outside; does nothing while it is not connected."""
        if self._session is not None and self._session.alive:
            await connection.send_external_position(self._session, position)

    async def looked_after(self) -> None:
        await commander.recover_from_crash(self._linked())

    async def identify(self) -> None:
        await actions.blink(self._linked())

    async def facts(self) -> Mapping[str, str]:
        return await firmware_facts(self._linked())

    @staticmethod
    def canonical_uri(uri: str) -> str:
        return address_of(uri).uri

    @staticmethod
    async def scan(options: Mapping[str, object]) -> Sequence[str]:
        return await scan(options_of(options))


def _heard(opening: asyncio.Task[None]) -> None:
    """Retrieve the exception: the caller may have given up."""
    if not opening.cancelled():
        opening.exception()
