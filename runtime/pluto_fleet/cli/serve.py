"""`serve`: the ground station in a browser."""

from __future__ import annotations

import asyncio
import os
import secrets
from collections.abc import Callable, Coroutine, Iterator
from contextlib import closing, contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ..files.reading import text_of
from ..flight.mission_status import finished, records_in
from ..jobs.reports import Down
from ..journal import place
from ..process import locks
from ..process import respawn as again
from ..process.apart import Apart
from ..process.text import in_shell
from ..shared import output
from ..shared.domain.app import moving
from ..shared.domain.errors import BadInput
from ..station.config import StationConfig
from ..station.flight_files import FlightFiles
from ..station.map.pictures import floor_plan, logo_of, title_of
from ..station.plan.plan import MissionPlan
from ..station.session import Phase
from ..station.station import Station
from ..station.web.audit import Audit
from ..station.web.guard import Guard, needs_token, proper_name
from ..station.web.listening import address, listening, port_of
from .interrupts import Interrupts
from .plans import load_fleet
from .preflight import check_flight
from .shutdown import run
from .supervise import Supervised, supervise

if TYPE_CHECKING:
    from socket import socket

    from ..app import App
    from ..station.web.api import Api
    from .options import Options

    Serve = Callable[[Api, socket, Callable[[], object]], Coroutine[object, object, None]]
    Web = tuple[type[Api], Serve]

HOW_TO_GO_ON = "serve shows what was interrupted, and Resume goes on with it"


def serve(app: App, options: Options) -> int:
    """Serve the station until it is interrupted; then land all drones."""
    options.refuse_what_is_simulated()
    web = _web_server(app.name)  # before anything is written or flown
    config = _config(app, options)
    app = moving(app, config.fleet.motion)
    check_flight(app, config.fleet, options)
    _make_room(config)
    if options.supervise:
        return _supervised(app, options, config)
    with closing(Apart(FlightFiles(app, config))) as files, _alone(config):
        (config.own_folder / LEFT_FILE).unlink(missing_ok=True)
        station = Station(app, config, _plan(app, options, config), files)
        leaving = _Leaving(station)
        mark = partial(_mark_regular_end, config)
        interrupts = Interrupts(leaving, leaving.journal, HOW_TO_GO_ON, last=mark)
        with interrupts.listening():
            run(_serve(web, options, config, station, interrupts))
        mark()
        return interrupts.code or 0


def _mark_regular_end(config: StationConfig) -> None:
    path = config.own_folder / LEFT_FILE
    try:
        path.touch()
    except OSError as error:  # its folder is gone, or may not be written any more
        why = error.strerror or error
        output.tell(f"{path}: cannot be written: {why}; a supervisor may start the station again")


def _web_server(app: str) -> Web:
    """Import what serves, or raise `BadInput` with how to install it."""
    try:
        from ..station.web.api import Api
        from ..station.web.server import serve
    except ImportError as error:
        if (error.name or "").startswith("pluto"):  # a bug
            raise
        package = app.rstrip("_")  # distribution names have no trailing underscore
        raise BadInput(
            "serve needs a web server, the extra `station` of this package:"
            f" pip install {in_shell(f'{package}[station]')}"
        ) from None
    return Api, serve


async def _serve(
    web: Web, options: Options, config: StationConfig, station: Station, interrupts: Interrupts
) -> None:
    interrupts.loop = asyncio.get_running_loop()
    with listening(options.host, _port(options, config)) as listener:
        guard = _guard(options, config, port_of(listener))
        audit = Audit(config.own_folder / "audit.log")
        make, serve_web = web
        api = make(station, guard, audit, logo=config.logo)
        station.begin(options.going_on)
        if options.going_on and station.phase is Phase.INTERRUPTED:
            station.resume()

        def ready() -> None:
            (config.own_folder / PORT_FILE).write_text(str(guard.port), encoding="utf-8")
            output.line(f"station: {address(guard, guard.token)}")
            if guard.watch_token is not None:
                output.line(f"to watch only: {address(guard, guard.watch_token)}")
            output.flush()
            if options.open:
                import webbrowser  # rarely needed, and slow to import

                webbrowser.open(address(guard, guard.token))

        server = asyncio.create_task(serve_web(api, listener, ready))
        leaves = asyncio.create_task(station.leaves.wait())
        await asyncio.wait([server, leaves], return_when=asyncio.FIRST_COMPLETED)
        if station.leaves.is_set():
            server.cancel()
            with suppress(asyncio.CancelledError):
                await server
        else:  # the server has ended by itself, which is a bug
            station.leave()
            await leaves
            await server


def _guard(options: Options, config: StationConfig, port: int) -> Guard:
    names = tuple(map(proper_name, options.names))
    guarded = needs_token(options.host, names)
    return Guard(
        host=options.host,
        port=port,
        names=names,
        token=_token(config, TOKEN_FILE) if guarded else None,
        watch_token=_token(config, WATCH_TOKEN_FILE) if guarded else None,
    )


class _Leaving:
    """Stops the flight, and then the station, on Ctrl-C."""

    def __init__(self, station: Station) -> None:
        self.asked: Down | None = None
        self._station = station

    def stop(self, _: Down) -> None:
        """Land all drones, and end the station."""
        self._station.leave()

    def journal(self) -> Path | None:
        """Return the journal that is being written."""
        session = self._station.session
        return session.journal if session is not None and session.lives else None


def _config(app: App, options: Options) -> StationConfig:
    fleet, text = load_fleet(app, options)
    folder = options.folder or place.folder_of(app.name)
    if options.fleet and fleet.landmarks.picture:
        try:
            floor_plan(options.fleet.parent, fleet.landmarks.picture.file)
        except BadInput as error:
            raise BadInput(f"{options.fleet}: {error}") from None
    return StationConfig(
        folder=folder,
        fleet=fleet,
        fleet_text=text,
        fleet_path=options.fleet,
        sim=options.sim,
        stand_ins=options.stand_ins,
        seed=options.seed,
        faults=options.fail,
        speed=options.speed,
        title=title_of(options.title) if options.title is not None else None,
        logo=logo_of(options.logo) if options.logo is not None else None,
    )


def _make_room(config: StationConfig) -> None:
    """Create the station's folder if needed."""
    folder = config.folder
    try:
        folder.mkdir(
            mode=0o700, parents=True, exist_ok=True
        )  # readable by this user only, with everything in it
        config.own_folder.mkdir(mode=0o700, exist_ok=True)
        if not os.access(config.own_folder, os.W_OK | os.X_OK):
            raise PermissionError(0, "it may only be read")
    except OSError as error:
        raise BadInput(
            f"{folder}: the station cannot keep anything there: {error.strerror}"
        ) from None


def _plan(app: App, options: Options, config: StationConfig) -> MissionPlan:
    plan = MissionPlan(app, config.fleet, config.own_folder / "plan.json")
    if options.plan is not None:
        if plan.is_empty:
            text, folder = text_of(options.plan), options.plan.parent
            plan.import_toml(text, plan.revision, str(options.plan), folder)
        elif not options.going_on:  # after a crash it has been said already
            output.tell(f"the plan that was drawn here stays: {options.plan} is not read")
    return plan


LEFT_FILE = "left"
"""The file that marks a regular end of the station."""

PORT_FILE = "port"
"""The file with the station's port, which is used again after a crash."""


def _port(options: Options, config: StationConfig) -> int:
    if options.going_on and not options.port:
        with suppress(OSError, ValueError):
            return int((config.own_folder / PORT_FILE).read_text(encoding="utf-8"))
    return options.port


TOKEN_FILE, WATCH_TOKEN_FILE = "token", "watch_token"


def _token(config: StationConfig, name: str) -> str:
    """Return a token, which is the same after a restart, so that open pages keep their access."""
    file = config.own_folder / name
    with suppress(OSError, ValueError):
        known = file.read_text(encoding="ascii").strip()
        if len(known) >= _TOKEN_BYTES:
            return known
    token = secrets.token_urlsafe(_TOKEN_BYTES)
    file.touch(mode=0o600)
    file.write_text(token, encoding="ascii")
    return token


_TOKEN_BYTES = 32
"""Bytes."""


@contextmanager
def _alone(config: StationConfig) -> Iterator[None]:
    """Lock the folder against other stations."""
    file = config.own_folder / "lock"
    lock = locks.take(file)
    if lock is None:
        raise BadInput(
            f"{config.folder}: another station is being served from there"
            f" (process {locks.holder(file)}): end that one, or name another folder with --folder"
        )
    try:
        yield
    finally:
        os.close(lock)


def _supervised(app: App, options: Options, config: StationConfig) -> int:
    """Serve in another process, and restart it when it crashes."""
    first = again.command(app.package, *options.supervised_words())

    def done() -> int:
        journal = place.newest_in(config.folder)
        with suppress(BadInput):  # damaged, or another app's: the station reports it
            return finished(records_in(app, journal)) if journal is not None else 0
        return 0

    return supervise(
        Supervised(
            name=app.name,
            first=first,
            again=lambda: [*(word for word in first if word != "--open"), "--going-on"],
            finished=done,
            over=lambda _: (config.own_folder / LEFT_FILE).exists(),
            how_to_go_on=HOW_TO_GO_ON,
        )
    )
