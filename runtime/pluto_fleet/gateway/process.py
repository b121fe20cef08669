"""The gateway as a process of its own, which runs none of the app's code and exits when not needed."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack, suppress
from errno import EDQUOT, EFBIG, ENOSPC
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..jobs.controls import FleetDrone
from ..jobs.reports import Down
from ..process import locks
from ..process.forked import deaf, in_children
from ..process.ipc import listening
from ..process.realtime import RealTime
from ..shared.domain.errors import BadInput
from ..shared.domain.motion import CRAZYFLIE
from ..shared.domain.text import printable
from ..shared.events.world import MovingWorld
from ..shared.time.kernel import FLEET, EventKind, Future
from ..simulation.drones import SimulatedNavigation
from ..simulation.world_store import WorldStore, this_moment, time_in_world
from .drone_lock import LEAVING, lock_drones
from .gateway import Gateway, Rehearse, TakeIn
from .ledger import Ledger
from .server import Server
from .settings import settings_of
from .sightings import SEEN, Sightings
from .wire import MAX_COMMAND

if TYPE_CHECKING:
    from ..drones.real_fleet import RealDrone
    from ..jobs.controls import Controls, FleetDrone
    from .settings import Settings


LINGERS = 120.0
"""Seconds to wait for a silent drone that may be hovering, when the gateway is not needed otherwise."""


class Ending:
    """Ends the process when it is not needed, and only after all drones have landed.

    A real drone that does not answer may still be in the air: it is landed if its link is back in
    time. A brain need not wait for that.
    """

    def __init__(self, gateway: Gateway, over: Future[None], settings: Settings) -> None:
        self._gateway, self._over = gateway, over
        self.second = settings.speed
        """A second on the wall, in the gateway's time."""
        self._idle, self._patience = settings.idle, settings.patience
        self.server: Server | None = None
        self._alone = -1.0
        """Seconds without a brain and without a drone in the air."""
        self._told: float | None = None
        """Seconds since it was asked to end."""
        self._lingers = 0.0 if settings.real is None else LINGERS
        self._left: float | None = None
        """Seconds left to wait for a drone that may be hovering."""

    def goodbye(self) -> None:
        """End once all drones have landed."""
        gateway = self._gateway
        if gateway.flies:
            gateway.fail_safe(Down.LAND).watch(lambda _: self._down())
        else:
            self._over.set(None)

    def _down(self) -> None:
        """End, as all reachable drones have landed; or wait for unreachable ones while no brain waits."""
        if not self._gateway.flies or self._lingers <= 0.0:
            self._over.set(None)
        elif self._left is None:
            self._left = self._lingers
            if self.server is not None:
                self.server.hang_up()

    def _linger(self, brain: bool) -> None:
        """Wait another second for a drone that may be hovering, and is landed when its link is back."""
        if brain:
            self._left = None
        elif self._left is not None:
            self._left -= 1.0
            gateway = self._gateway
            if self._left <= 0.0 or not (gateway.flies or gateway.descent is not None):
                self._over.set(None)

    def told_to_end(self) -> None:
        """End as by `goodbye`, but leave a brain with the same signal the time to stop."""
        if self._told is None:
            self._told = 0.0

    def look(self) -> None:
        """End when no brain has connected for a while; else check again a second later."""
        gateway, kernel = self._gateway, self._gateway.kernel
        brain = self.server is not None and self.server.has_a_brain
        busy = brain or gateway.flies or gateway.descent is not None
        self._alone = -1.0 if busy else self._alone + 1.0
        self._linger(brain)
        if self._told is not None:
            self._told += 1.0
            if self._told > self._patience and gateway.descent is None and self._left is None:
                self.goodbye()
        if self._alone > (self._idle if self._told is None else 0.0):
            self._over.set(None)
        kernel.at(kernel.now + self.second, EventKind.CLOCK, FLEET, self.look)


NOTE, SETTINGS, LEDGER, LOCK, LOG = "gateway", "settings.json", "ledger", "lock", "log"
"""The files in its folder; NOTE has the address at which it listens."""

ANOTHER_RUNS, CANNOT, NO_ROOM = 3, 4, 5
"""Exit codes; on a full disk they are the only message, as the log cannot be written either."""

_FOR_APPS = "gateway: an app starts this by itself when it flies; there is nothing to do by hand"


def main(arguments: Sequence[str]) -> int:
    """Run the gateway of a folder until it is not needed any more."""
    folder = Path(*arguments[:1])
    if len(arguments) != 1 or not os.path.isfile(folder / SETTINGS):
        print(_FOR_APPS, file=sys.stderr)
        return 2
    try:
        return _alone(folder)
    except OSError as error:
        if error.errno not in (ENOSPC, EDQUOT, EFBIG):
            raise
        return NO_ROOM


def _alone(folder: Path) -> int:
    """Run the gateway of a folder, unless another one does."""
    lock = locks.take(folder / LOCK)
    if lock is None:
        return ANOTHER_RUNS
    try:
        asyncio.run(run(folder, _settings(folder / SETTINGS)))
    except BadInput as error:
        print(error, file=sys.stderr)
        return CANNOT
    finally:
        os.close(lock)
    return 0


def _settings(file: Path) -> Settings:
    """Return the settings that the app has written."""
    try:
        return settings_of(json.loads(file.read_text(encoding="utf-8")))
    except ValueError as error:
        raise BadInput(f"{file}: these are no settings of a gateway: {error}") from None


async def run(folder: Path, settings: Settings) -> None:
    """Connect the drones, or resume the simulated world, and serve brains until the end."""
    if settings.real is None:
        kernel = RealTime(settings.speed, time_in_world(folder, settings.speed, this_moment()))
        simulated, keeper = _simulated(folder, settings, kernel)
        seen = Sightings(folder / SEEN, simulated.telemetry, down=simulated.down)

        def take_in(drone: FleetDrone, _: object) -> None:
            simulated.join(drone)
            keeper.watch(drone.id)

        moving = settings.world is not None and bool(settings.world.movers)
        tracker = simulated.tracks if moving else None
        rehearse = simulated.mishap
        await _command(folder, settings, kernel, simulated, seen, take_in, rehearse, tracker)
        return
    from ..drones.team import make_team  # not needed in a simulation

    kernel = RealTime(settings.speed)
    uris = {drone.id: drone.uri or drone.id for drone in settings.real.drones}
    with lock_drones(uris, patience=LEAVING), ExitStack() as joined:
        team = make_team(kernel, settings.drones, settings.real, settings.airspace, folder, _say)
        team.begin()
        seen = Sightings(folder / SEEN, team.telemetry, down=team.down)

        def take_in_real(drone: FleetDrone, how: RealDrone | None) -> None:
            assert how is not None
            joined.enter_context(lock_drones({drone.id: how.uri or drone.id}))
            team.join(drone, how)

        try:
            tracks = None if team.tracking is None else team.tracking.news
            await _command(folder, settings, kernel, team, seen, take_in_real, tracker=tracks)
        finally:
            await team.close()
            seen.keep()


def _simulated(
    folder: Path, settings: Settings, kernel: RealTime
) -> tuple[SimulatedNavigation, WorldStore]:
    """Return the simulated drones, and their stored world."""
    keeper = WorldStore(folder, kernel.time, settings.speed, this_moment)
    navigation = SimulatedNavigation(
        kernel,
        settings.drones,
        MovingWorld(settings.seed, settings.airspace, settings.world),
        settings.faults,
        settings.seed,
        keeper.record,
    )
    keeper.take_over(navigation.bodies)
    kernel.settled = keeper.settled
    return navigation, keeper


def _slack(settings: Settings) -> float:
    """Return how much further apart drones are kept, as they are not exactly on their way."""
    slack = max((drone.category.motion.slack for drone in settings.drones), default=0.0)
    return slack if settings.real is None else max(slack, CRAZYFLIE.slack)


async def _command(
    folder: Path,
    settings: Settings,
    kernel: RealTime,
    controls: Controls,
    seen: Sightings,
    take_in: TakeIn,
    rehearse: Rehearse | None = None,
    tracker: Callable[[], Mapping[str, Any]] | None = None,
) -> None:
    """Serve brains; `take_in` gives drones that join to the controls, `rehearse` has mishaps happen.

    `tracker` says where things are that move.
    """
    gateway = Gateway(
        kernel,
        controls,
        settings.drones,
        settings.airspace,
        ledger=Ledger(folder / LEDGER),
        apart=settings.apart,
        slack=_slack(settings),
        max_airborne=settings.max_airborne,
        patience=settings.patience * settings.speed,
        leaving=seen.leaving,
        measures=True,
    )
    gateway.take_in = take_in
    gateway.rehearse = rehearse
    gateway.tracker = tracker
    over: Future[None] = Future()
    ending = Ending(gateway, over, settings)
    server = Server(gateway, _say, ending.goodbye)
    ending.server = server

    def pass_at(speed: float) -> None:
        if speed == kernel.speed:
            return
        _say(f"time passes {speed:g} times as fast from now on")
        kernel.pass_at(speed)
        gateway.patience = settings.patience * speed
        ending.second = speed

    if settings.real is None:
        server.pass_at = pass_at
    for number in (signal.SIGTERM, signal.SIGINT):
        asyncio.get_running_loop().add_signal_handler(number, kernel.post, ending.told_to_end)
    no_more = in_children(deaf)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    turned_away = partial(_say, "a client was turned away: too many are connected")
    try:
        async with listening(
            folder / NOTE,
            server.serve,
            max_line=MAX_COMMAND,
            last_words=0.0,
            turned_away=turned_away,
        ):
            watching = seen.subscribe(settings.speed)
            try:
                _say("the gateway is ready")
                kernel.post(ending.look)
                await kernel.run(over)
            finally:
                watching.cancel()
                seen.keep()
    finally:
        no_more()
    _say("the gateway ends: all drones are down")


def _say(what: str) -> None:
    """Write a line of the log; one that cannot be written is dropped.

    Control characters are escaped, as it may contain texts of other people's classes.
    """
    said = "\n".join(map(printable, what.split("\n")))
    with suppress(OSError):
        print(f"{time.strftime('%Y-%m-%d %H:%M:%S')} {said}", file=sys.stderr, flush=True)
