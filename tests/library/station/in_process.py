"""A ground station over all its lives, and its gateways, in this process and in time that jumps."""

from __future__ import annotations

import asyncio
import json
import shutil
import signal
from collections.abc import AsyncGenerator, Callable, Collection, Coroutine, Iterable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar
from urllib.parse import parse_qsl

import pytest

from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.flight import live_flight
from pluto_fleet.gateway import process, starting
from pluto_fleet.gateway.process import SETTINGS
from pluto_fleet.gateway.settings import Settings, data_of
from pluto_fleet.journal.reader import Reader
from pluto_fleet.process import wall_clock
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.simulation.drones import SimulatedBody, SimulatedNavigation
from pluto_fleet.simulation.world_store import Moment
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.plan.plan import MissionPlan
from pluto_fleet.station.preflight import preflight
from pluto_fleet.station.station import Station
from pluto_fleet.station.web.api import Api
from pluto_fleet.station.web.audit import Audit
from pluto_fleet.station.web.guard import Guard
from tests.kill.judge import done_by_the_world
from tests.kit.apps import EXAMPLES, example, fly_straight
from tests.kit.station import Asked

from .in_threads import InThreads
from .jumping import AtOnce, JumpingLoop
from .server.asking import OURS, Asgi, Reply, request

T = TypeVar("T")

PATIENCE = 3_000
"""Looks until something that does not happen is called a failure."""
A_MOMENT = 0.05
"""Seconds between two looks, of the loop's time."""


class _Gateway:
    """A gateway that is a task of the loop; it is asked how it is as if it were a process."""

    def __init__(self, run: asyncio.Task[None]) -> None:
        self.run = run

    def poll(self) -> int | None:
        """Return its exit code."""
        return 0 if self.run.done() else None

    def kill(self) -> None:
        """End it at once."""
        self.run.cancel()


@dataclass(kw_only=True)
class World:
    """The loop, and what flies in it."""

    loop: JumpingLoop = field(default_factory=JumpingLoop)
    gateways: list[_Gateway] = field(default_factory=list)
    kernels: list[RealTime] = field(default_factory=list)
    """The clocks of the gateways."""
    bodies: dict[str, SimulatedBody] = field(default_factory=dict)
    """The drones as they are, of the newest gateway."""

    def run(self, work: Coroutine[Any, Any, T]) -> T:
        """Let time pass until this is done."""
        return self.loop.run_until_complete(work)

    def start(self, folder: Path, settings: Settings, _: object) -> _Gateway:
        """Start a gateway."""
        folder.mkdir(parents=True, exist_ok=True)
        (folder / SETTINGS).write_text(json.dumps(data_of(settings)), "utf-8")
        self.gateways.append(_Gateway(self.loop.create_task(process.run(folder, settings))))
        return self.gateways[-1]

    def moment(self) -> Moment:
        """Return what a simulated world takes for the time of day."""
        return Moment(wall=self.loop.now, boot="", up=0.0)

    def clock(self, *given: float) -> RealTime:
        """Make a gateway's clock, and remember it."""
        self.kernels.append(RealTime(*given))
        return self.kernels[-1]

    def navigation(self, *given: Any) -> SimulatedNavigation:
        """Make simulated drones, and remember them."""
        made = SimulatedNavigation(*given)
        self.bodies = made.bodies
        return made

    def stop_gateway(self) -> None:
        """Kill the gateway, as nothing can be kept from."""
        gateway = self.gateways[-1].run
        gateway.cancel()
        self.run(_ended([gateway]))


async def in_this_process(work: Callable[[], Iterable[T]]) -> AsyncGenerator[T, None]:
    """Do what forecasts do in a copy of the process."""
    for found in work():
        yield found


@contextmanager
def world(patch: pytest.MonkeyPatch) -> Iterator[World]:
    """Let all gateways run as tasks of one loop; end them at last."""
    patch.setattr(preflight, "in_a_copy", in_this_process)
    hangs_up, here = signal.getsignal(signal.SIGHUP), World()
    patch.setattr(live_flight, "Writer", AtOnce)
    patch.setattr(wall_clock, "now", lambda: here.loop.now)
    patch.setattr(starting, "start", here.start)
    patch.setattr(process, "RealTime", here.clock)
    patch.setattr(process, "this_moment", here.moment)
    patch.setattr(process, "SimulatedNavigation", here.navigation)
    try:
        yield here
    finally:
        left = asyncio.all_tasks(here.loop)
        for task in left:
            task.cancel()
        here.run(_ended(left))
        here.run(here.loop.shutdown_default_executor())
        for kernel in here.kernels * 2:  # to end one thing may begin another
            kernel.close()
        here.loop.close()
        signal.signal(signal.SIGHUP, hangs_up)


async def _ended(tasks: Collection[asyncio.Task[Any]]) -> None:
    await asyncio.gather(*tasks, return_exceptions=True)


@dataclass(kw_only=True)
class Flown(Asked):
    """A station over all its lives: one folder, asked as its pages do."""

    world: World
    name: str
    """The example that it serves."""
    folder: Path
    options: dict[str, Any]

    def __post_init__(self) -> None:
        self.fleet = self.folder.with_name(f"{self.folder.name}.toml")
        shutil.copyfile(EXAMPLES / self.name / "fleet.toml", self.fleet)
        fly_straight(self.fleet)
        self.start()

    def start(self) -> None:
        """Let a life begin."""
        app = example(self.name).app
        fleet = load_fleet(self.fleet, app)
        config = StationConfig(
            folder=self.folder,
            fleet=fleet,
            fleet_text=self.fleet.read_text("utf-8"),
            fleet_path=self.fleet,
            **{"speed": 30.0, "faults": {}, **self.options},
        )
        config.own_folder.mkdir(parents=True, exist_ok=True)
        app = moving(app, fleet.motion)
        plan = MissionPlan(app, fleet, config.own_folder / "plan.json")
        if plan.is_empty:
            files = EXAMPLES / self.name
            missions = (files / "missions.toml").read_text("utf-8")
            plan.import_toml(missions, plan.revision, folder=files)
        self.life = Station(app, config, plan, InThreads(app, config))
        self.api = Asgi(self.served(Guard(host="127.0.0.1", port=8765)))
        self.world.run(self._begun())

    def served(self, guard: Guard) -> Api:
        """Serve this life to those whom a guard lets in."""
        clock, log = self.world.loop.time, self.folder / "station" / "audit.log"
        return Api(self.life, guard, Audit(log, clock=clock), clock=clock)

    async def _begun(self) -> None:
        self.life.begin()

    def kill(self) -> None:
        """Let the app die in the midst of its flight; its gateway goes on."""
        session = self.life.session
        if session is not None and session.task is not None:
            session.task.cancel()
            self.world.run(_ended([session.task]))

    def end(self) -> None:
        """Tell it to end, as Ctrl-C does."""

        async def leave() -> None:
            self.life.leave()
            await self.life.leaves.wait()

        self.world.run(leave())

    def ask(self, method: str, path: str, body: object = b"", **query: str) -> Reply:
        """Ask as a page does."""
        return self.world.run(self.api.answer(request(method, path, body, OURS, **query)))

    def _ask(self, method: str, path: str, given: object = None) -> tuple[int, Any]:
        address, _, query = path.partition("?")
        asked = dict(parse_qsl(query, keep_blank_values=True))
        reply = self.ask(method, address, b"" if given is None else given, **asked)
        return reply.status, json.loads(reply.body)

    def until(self, holds: Callable[[], object], what: str) -> None:
        """Let time pass until something holds."""
        for _ in range(PATIENCE):
            if holds():
                return
            self.world.run(asyncio.sleep(A_MOMENT))
        raise AssertionError(f"it never came about that {what}")

    def comes_to(self, phase: str) -> None:
        """Let time pass until this goes on."""
        self.until(lambda: self.phase == phase, f"the station is {phase}")

    def flying(self) -> Flown:
        """Start the whole plan, and wait until something flies."""
        self.tell("start")
        self.until(lambda: self.events("trip.launched"), "something flies")
        return self

    def ends(self) -> dict[str, Any]:
        """Return how the missions of the plan have ended."""
        return {one["name"]: one["ended"] for one in self.missions}

    def keys(self) -> dict[str, str]:
        """Return the keys of the missions of the plan."""
        return {one["name"]: one["key"] for one in self.missions}

    def journals(self) -> list[Path]:
        """Return the journals of its flights, the first one first."""
        return sorted(self.folder.glob("*.journal"), key=lambda path: path.stem)

    def events(self, kind: str) -> list[dict[str, Any]]:
        """Return the events of one kind, of all flights."""
        found: list[dict[str, Any]] = []
        for journal in self.journals():
            with closing(Reader(journal)) as reader:
                found += [event for _, event in reader.events()]
        return [event for event in found if event["event"] == kind]

    def completes_all_once(self) -> None:
        """Let all missions fly to their end; hold that nothing was done twice."""
        self.comes_to("over")
        assert set(self.statuses().values()) == {"COMPLETED"}
        done = [(e["mission"], e["trip"], e["round"]) for e in self.events("trip.completed")]
        assert len(done) == len(set(done))
        assert set(done_by_the_world(self.journals()[-1]).values()) <= {1}
