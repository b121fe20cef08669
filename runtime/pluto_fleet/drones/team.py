"""A team of real drones: each flown by a navigation of its own, none kept waiting by another.

The gateway's kernel commands, and asyncio flies: a command of the kernel is a task beside it, under
a limit, and whatever becomes of the task becomes of the command.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, NoReturn

from plutoc_runtime.domain.actions import BUILT_IN, Plain

from ..jobs.reports import DroneReport
from ..jobs.telemetry import Publisher
from . import acting, flying
from .cargo import Cargo
from .closing import close
from .linking import Linking
from .listening import listen
from .reaching import fetched, reach
from .vehicle import Member, TeamDrone
from .watch import EACH, Watch

if TYPE_CHECKING:
    from pathlib import Path

    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.errors import FlightFailed
    from plutoc_runtime.domain.model import Item, Point, Telemetry
    from plutoc_runtime.time.kernel import Kernel

    from ..jobs.job import Job
    from ..jobs.telemetry import Subscription
    from .feeding import Feeding
    from .real_fleet import Wanted

__all__ = ["Team", "TeamDrone"]


class Team:
    """The `Controls` of real drones, by their ids; used inside a running asyncio loop."""

    def __init__(
        self,
        kernel: Kernel,
        drones: Sequence[TeamDrone],
        airspace: Airspace,
        *,
        folder: Path,
        say: Callable[[str], object],
        wanted: Sequence[Wanted] = (),
        feeding: Feeding | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._kernel, self._wanted = kernel, tuple(wanted)
        self._cargo, self._feeding = Cargo(folder, say), feeding
        self._members = {drone.id: Member(drone, self._cargo, say, clock) for drone in drones}
        self.telemetry: Mapping[str, Telemetry] = {
            id: member.seen for id, member in self._members.items()
        }
        """What is known of each drone; the values stay current."""
        self._links = {id: Linking(member) for id, member in self._members.items()}
        self._watch = Watch(tuple(self._members.values()), airspace, say, clock)
        self._tasks: list[asyncio.Task[None]] = []
        self._watching: Subscription[float] | None = None
        for member in self._members.values():
            member.lacks = partial(self._lacks, member)
            if feeding is not None:
                member.blind = partial(feeding.silent, member.id)

    def begin(self) -> None:
        """Connect to all drones at once, and watch them; waits for none of them."""
        if self._feeding is not None:
            self._feeding.start()
        self._watching = Publisher(self.telemetry).subscribe(
            self._look, every=EACH, view=lambda _, known: known.silence
        )
        for member in self._members.values():
            self._tasks.append(asyncio.ensure_future(listen(member)))
            self._tasks.append(self._links[member.id].start())
        for task in self._tasks:
            task.add_done_callback(self._ended)

    def _look(self, _: Mapping[str, float], late: float) -> None:
        """Let the monitor look; without it no drone may fly: if it breaks, all ends, and all land."""
        try:
            self._watch.hear(late)
        except Exception as error:
            if self._watching is not None:
                self._watching.cancel()
            self._kernel.post(_raise, error)

    def _ended(self, task: asyncio.Task[None]) -> None:
        """If what keeps a link or hears events breaks, all ends, and all land first."""
        error = None if task.cancelled() else task.exception()
        if error is not None:
            self._kernel.post(_raise, error)

    async def close(self) -> None:
        """Land what flies, wait until it has, and let go of all drones; nothing is left of it."""
        await close([(member, self._links[id]) for id, member in self._members.items()])
        if self._watching is not None:
            self._watching.cancel()
        tasks = [*self._tasks, *self._watch.stop()]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        if self._feeding is not None:
            await self._feeding.close()

    # What the gateway's kernel commands

    def down(self, drone: str) -> FlightFailed | None:
        """Return why a drone takes no commands though it can be reached; None: it takes them."""
        return self._members[drone].down

    def why_not(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why a drone's hardware cannot do a built-in action, or None."""
        return acting.why_not(self._members[drone], action, parameters)

    def begins(self, drone: str, job: Job | None, seconds: float) -> None:
        """A flight begins: raise `FlightFailed` where the drone takes no commands."""
        self._members[drone].check()

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise straight up to a height, if it is ready; does nothing for a drone that flies."""
        await self._kernel.call_hook(flying.takeoff, self._members[drone], height)

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        await self._kernel.call_hook(flying.go_to, self._members[drone], target)

    async def land(self, drone: str) -> None:
        """Land here; does nothing for a drone that stands on the ground."""
        await self._kernel.call_hook(flying.land, self._members[drone])

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes; never returns by itself."""
        await self._kernel.call_hook(flying.hold, self._members[drone])

    async def act(
        self,
        drone: str,
        action: str,
        parameters: Mapping[str, Plain],
        item: Item | None,
        job: str | None,
    ) -> object:
        """Do one of the built-in actions here, and return what came of it."""
        return await self._kernel.call_hook(
            acting.act, self._members[drone], action, parameters, item
        )

    async def read(self, drone: str, name: str) -> float:
        """Return what a drone measures under this name."""
        value = await self._kernel.call_hook(acting.read, self._members[drone], name)
        return float(str(value))

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone has under this name."""
        await self._kernel.call_hook(acting.write, self._members[drone], name, value)

    def break_off(self, drone: str) -> None:
        """Stop whatever a drone does, and hover; a command under way raises `FlightFailed`."""
        self._members[drone].break_off()

    async def cut(self, drone: str) -> None:
        """Switch its motors off now, wherever it is."""
        await self._kernel.call_hook(flying.cut, self._members[drone])

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it may be asked anew."""
        member = self._members[drone]
        if not member.must_land:
            member.is_well()
            member.looked_after = True

    async def reach(self, drone: str) -> bool:
        """Wait, after a failed flight, until a drone takes commands again; False: it is lost."""
        return bool(await self._kernel.call_hook(reach, self._members[drone], self._links[drone]))

    async def fetched(self, drone: str) -> bool:
        """Wait until somebody has put a drone back into its dock, well; False: nobody does."""
        return bool(await self._kernel.call_hook(fetched, self._members[drone]))

    def unload(self, drone: str) -> None:
        """Whoever meets it takes off what it carries."""
        self._cargo.carries(drone, None)

    async def roll_call(self, drone: str) -> DroneReport:
        """Ask a drone where it is, and whether it may fly; say so if it does not answer."""
        await self._kernel.call_hook(self._links[drone].once)
        member = self._members[drone]
        problems: object = await self._kernel.call_hook(self._problems, member)
        return self._standing(member, problems if isinstance(problems, tuple) else ())

    def _standing(self, member: Member, problems: tuple[str, ...]) -> DroneReport:
        seen = member.seen
        return DroneReport(
            drone=member.id,
            reached=member.linked,
            location=seen.location,
            landed=seen.landed,
            battery_level=seen.battery_level,
            boot=member.boot,
            carrying=self._cargo.of(member.id),
            done=None,
            problems=problems,
        )

    async def _problems(self, member: Member) -> tuple[str, ...]:
        """Return why a drone may not fly: none for one that does."""
        if not member.linked:
            return (member.out_of_reach,)
        if not member.seen.landed:
            return ()
        down = () if member.down is None else (str(member.down),)
        news = [why for why in await member.preflight() if not any(why in one for one in down)]
        return (*down, *news, *member.lacks())

    def _lacks(self, member: Member) -> tuple[str, ...]:
        """Return which actions its category can do, and its hardware cannot."""
        lacks: list[str] = []
        for wanted in self._wanted:
            if wanted.action in BUILT_IN and member.drone.category.can(wanted.action):
                why = acting.why_not(member, wanted.action, wanted.parameters)
                if why is not None and why not in lacks:
                    lacks.append(why)
        return tuple(lacks)


def _raise(error: BaseException) -> NoReturn:
    raise error
