"""The driver's layer: a team of real drones, each flown by a navigation of its own, as its make does it.

A command of the gateway's kernel runs as an asyncio task with a time-out, and ends as the task does.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, NoReturn

from ..files.fleet import OWN
from ..jobs.controls import Command, FleetDrone, GoTo
from ..jobs.reports import DroneReport
from ..jobs.telemetry import Subscription, Telemetry
from ..shared.domain.actions import BUILT_IN, Plain
from ..shared.domain.airspace import Airspace
from ..shared.domain.errors import ANY_ERROR, BadInput, FlightFailed
from ..shared.domain.model import Point
from ..shared.domain.text import quoted
from . import commands
from .connection import Connection, close, recover, wait_until_home
from .loading import deaf, make_localization, make_navigation, make_tracker
from .localization import LocalizationFeed
from .protocol import (
    DroneNavigation,
    DroneSetup,
    InView,
    Locatable,
    Readable,
    nothing_in_view,
)
from .real_fleet import RealDrone, RealFleet
from .safety import EACH, SafetyMonitor, follow_events
from .tracking import TrackFeed
from .vehicle import Cargo, Vehicle

if TYPE_CHECKING:
    from pathlib import Path

    from ..process.realtime import RealTime


class Team:
    """The `Controls` of real drones, by their ids; used inside a running asyncio loop."""

    def __init__(
        self,
        kernel: RealTime,
        drones: Sequence[FleetDrone],
        navigations: Mapping[str, DroneNavigation],
        airspace: Airspace,
        *,
        folder: Path,
        say: Callable[[str], object],
        real: RealFleet = RealFleet(),  # noqa: B008 - it is frozen
        feeding: LocalizationFeed | None = None,
        tracking: TrackFeed | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._kernel = kernel
        self._real, self._airspace = real, airspace
        self._cargo, self._feed = Cargo(folder, say), feeding
        self.tracking = tracking
        """What says where things are that move; None: nothing does."""
        self._say, self._clock, self._folder = say, clock, folder
        self.vehicles: dict[str, Vehicle] = {}
        """Each drone as it is flown, by its id."""
        self._told: dict[str, Telemetry] = {}
        self.telemetry: Mapping[str, Telemetry] = self._told
        """The drones' telemetry, always current."""
        self._links: dict[str, Connection] = {}
        self._monitor = SafetyMonitor(airspace, say, clock, real.silence)
        self._tasks: list[asyncio.Task[None]] = []
        self._monitoring: Subscription[float] | None = None
        parameters = {drone.id: drone.parameters for drone in real.drones}
        for drone in drones:
            self._have(drone, navigations[drone.id], parameters.get(drone.id, {}))

    def _have(
        self, drone: FleetDrone, navigation: DroneNavigation, parameters: Mapping[str, float]
    ) -> Vehicle:
        vehicle = Vehicle(drone, navigation, self._cargo, self._say, self._clock, parameters)
        self.vehicles[drone.id], self._told[drone.id] = vehicle, vehicle.telemetry
        self._links[drone.id] = Connection(vehicle)
        self._monitor.watch(vehicle)
        vehicle.missing_actions = partial(self._lacks, vehicle)
        if self._feed is not None:
            vehicle.position_problem = partial(self._feed.silent, vehicle.id)
        return vehicle

    def join(self, drone: FleetDrone, how: RealDrone) -> None:
        """Have one more drone, and connect to it; raise `BadInput` if it cannot be flown.

        Its navigation must be one that is flown already: to load another may hold up all drones.
        """
        if how.navigation not in {drone.navigation for drone in self._real.drones}:
            raise BadInput(
                f"{drone.id} cannot join: no drone of this flight is flown by {how.navigation}, and to"
                " load it would hold up those in the air; end this flight, and begin one with it"
            )
        files = self._folder / FILES
        speed = drone.category.speed
        view = _view_of(self.tracking)
        airspace = self._airspace
        navigation = make_one(how, drone.home, speed, files, self._real, airspace, view)
        if self._feed is not None:
            if not isinstance(navigation, Locatable):
                raise deaf(self._feed.name, [drone.id])
            self._feed.feed(drone.id, navigation)
        self._connect(self._have(drone, navigation, how.parameters))

    def begin(self) -> None:
        """Start to connect to all drones, and to monitor them; waits for none."""
        if self._feed is not None:
            self._feed.start()
        if self.tracking is not None:
            self.tracking.start()
        self._monitoring = Subscription(
            self.telemetry, self._look, every=EACH, view=lambda _, known: known.silence
        )
        for vehicle in self.vehicles.values():
            self._connect(vehicle)

    def _connect(self, vehicle: Vehicle) -> None:
        tasks = [asyncio.ensure_future(follow_events(vehicle)), self._links[vehicle.id].start()]
        for task in tasks:
            task.add_done_callback(self._ended)
        self._tasks += tasks

    def _look(self, _: Mapping[str, float], late: float) -> None:
        """Run the safety checks; if they raise, all drones land, and the team ends."""
        try:
            self._monitor.hear(late)
        except ANY_ERROR as error:
            if self._monitoring is not None:
                self._monitoring.cancel()
            self._kernel.post(_raise, error)

    def _ended(self, task: asyncio.Task[None]) -> None:
        """If a task that keeps a link or handles events raises, all drones land, and the team ends."""
        error = None if task.cancelled() else task.exception()
        if error is not None:
            self._kernel.post(_raise, error)

    async def close(self) -> None:
        """Land all drones in the air, wait until they have, and close all links."""
        await close([(vehicle, self._links[id]) for id, vehicle in self.vehicles.items()])
        if self._monitoring is not None:
            self._monitoring.cancel()
        tasks = [*self._tasks, *self._monitor.stop()]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        if self._feed is not None:
            await self._feed.close()
        if self.tracking is not None:
            await self.tracking.close()

    # Commands of the gateway's kernel

    def down(self, drone: str) -> FlightFailed | None:
        """Return why a drone takes no commands though it can be reached; None: it takes them."""
        return self.vehicles[drone].down

    def why_not(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> str | None:
        return commands.why_not(self.vehicles[drone], action, parameters)

    def begins(self, drone: str, flight: str | None, seconds: float) -> None:
        self.vehicles[drone].check()

    async def do(self, drone: str, command: Command) -> object:
        return await self._kernel.call_hook(commands.do, self.vehicles[drone], command)

    def turn(self, drone: str, command: GoTo) -> bool:
        return self.vehicles[drone].turn(command)

    def break_off(self, drone: str) -> None:
        self.vehicles[drone].break_off()

    def mended(self, drone: str) -> None:
        vehicle = self.vehicles[drone]
        if not vehicle.must_land:
            vehicle.clear_failure()
            vehicle.looked_after = True

    async def reach(self, drone: str) -> bool:
        return bool(await self._kernel.call_hook(recover, self.vehicles[drone], self._links[drone]))

    async def fetched(self, drone: str) -> bool:
        return bool(await self._kernel.call_hook(wait_until_home, self.vehicles[drone]))

    def unload(self, drone: str) -> None:
        self._cargo.carries(drone, None)

    async def drone_report(self, drone: str) -> DroneReport:
        await self._kernel.call_hook(self._links[drone].once)
        vehicle = self.vehicles[drone]
        problems: object = await self._kernel.call_hook(self._problems, vehicle)
        telemetry = vehicle.telemetry
        return DroneReport(
            drone=vehicle.id,
            reached=vehicle.linked,
            location=telemetry.location,
            landed=telemetry.landed,
            battery_level=telemetry.battery_level,
            boot=vehicle.boot,
            carrying=self._cargo.of(vehicle.id),
            done=None,
            problems=problems if isinstance(problems, tuple) else (),
        )

    async def _problems(self, vehicle: Vehicle) -> tuple[str, ...]:
        """Return why a drone may not fly; empty for one in the air."""
        if not vehicle.linked:
            return (vehicle.out_of_reach,)
        if not vehicle.telemetry.landed:
            return ()
        down = () if vehicle.down is None else (str(vehicle.down),)
        news = [why for why in await vehicle.preflight() if not any(why in one for one in down)]
        return (*down, *news, *vehicle.missing_actions())

    def _lacks(self, vehicle: Vehicle) -> tuple[str, ...]:
        """Return the actions that its category can do, but not its hardware."""
        lacks: list[str] = []
        for wanted in self._real.wanted:
            if wanted.action in BUILT_IN and vehicle.drone.category.can(wanted.action):
                why = commands.why_not(vehicle, wanted.action, wanted.parameters)
                if why is not None and why not in lacks:
                    lacks.append(why)
        return tuple(lacks)


def _raise(error: BaseException) -> NoReturn:
    raise error


FILES = "files"
"""The folder, within the gateway's, for photos and other files of navigations."""


def make_one(
    how: RealDrone,
    home: Point,
    speed: float,
    folder: Path,
    fleet: RealFleet = RealFleet(),  # noqa: B008 - it is frozen
    airspace: Airspace | None = None,
    in_view: InView = nothing_in_view,
) -> DroneNavigation:
    """Create one drone's navigation, with a maximum speed, in its fleet; nothing is connected yet.

    `BadInput`: its options are wrong.
    """
    setup = DroneSetup(
        id=how.id,
        uri=how.uri,
        home=home,
        speed=speed,
        options=how.options,
        folder=folder,
        silence=fleet.silence,
        plane=fleet.plane,
        airspace=airspace,
        in_view=in_view,
    )
    made = make_navigation(how.navigation, setup)
    if how.parameters and not isinstance(made, Readable):
        raise BadInput(
            f"{how.id}: its parameters cannot be set: the navigation {quoted(how.navigation)} has no"
            " method write"
        )
    return made


def make_team(
    kernel: RealTime,
    drones: Sequence[FleetDrone],
    real: RealFleet,
    airspace: Airspace,
    folder: Path,
    say: Callable[[str], object],
) -> Team:
    """Return the team of a fleet; raise `BadInput` if it cannot be flown as its file says."""
    files = folder / FILES
    files.mkdir(mode=0o700, parents=True, exist_ok=True)
    how = {drone.id: drone for drone in real.drones}
    tracking = _tracking(real, airspace, say)
    view = _view_of(tracking)
    navigations = {
        drone.id: make_one(
            how[drone.id], drone.home, drone.category.speed, files, real, airspace, view
        )
        for drone in drones
    }
    return Team(
        kernel,
        drones,
        navigations,
        airspace,
        folder=folder,
        say=say,
        real=real,
        feeding=_feeding(real, navigations, say),
        tracking=tracking,
    )


def _feeding(
    real: RealFleet, navigations: Mapping[str, DroneNavigation], say: Callable[[str], object]
) -> LocalizationFeed | None:
    """Return the feed of the fleet's localization; None: the drones localize themselves."""
    if real.localization == OWN:
        return None
    fed = {id: one for id, one in navigations.items() if isinstance(one, Locatable)}
    if len(fed) < len(navigations):
        raise deaf(real.localization, [id for id in navigations if id not in fed])
    source = make_localization(real.localization, real.localization_options)
    return LocalizationFeed(real.localization, source, fed, say)


def _tracking(
    real: RealFleet, airspace: Airspace, say: Callable[[str], object]
) -> TrackFeed | None:
    """Return the feed of the fleet's tracker; None: it has none."""
    if real.tracker is None:
        return None
    tracker = make_tracker(real.tracker, real.tracker_options)
    return TrackFeed(real.tracker, tracker, airspace, say)


def _view_of(tracking: TrackFeed | None) -> InView:
    """Return what looks into what a tracker sees."""
    return nothing_in_view if tracking is None else tracking.in_view
