"""Between the brain and its drones: every command passes here, and may outlive whoever gave it.

A brain commands through a `Link`. When another brain links, or the brain's heartbeat stays away, the
old link is cut: it commands nothing any more, and hears nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import BadInput, FlightFailed
from plutoc_runtime.time.kernel import FLEET, Cancelled, Kernel, Kind, Task

from ..jobs.reports import Down, DroneReport, FleetReport
from .descent import Craft, Descent
from .envelope import Envelope
from .executor import Leaving, Pilots
from .jobs import Jobs
from .link import Link
from .traffic.traffic import Traffic

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace

    from ..jobs.controls import Controls
    from .job import Report
    from .ledger import Ledger


class Gateway:
    """All drones of one fleet, and the jobs that they were given.

    Without a ledger what is over is forgotten: nobody will come back and ask. Without patience
    nothing is landed because the brain is silent.
    """

    def __init__(
        self,
        kernel: Kernel,
        controls: Controls,
        drones: Sequence[Craft],
        airspace: Airspace,
        *,
        ledger: Ledger | None = None,
        apart: float = 0.5,
        slack: float = 0.0,
        max_airborne: int | None = None,
        patience: float | None = None,
        leaving: Leaving | None = None,
    ) -> None:
        self.kernel = kernel
        self.traffic: Traffic | None = None
        """Keeps drones apart from each other, if anybody wants that."""
        if apart > 0:
            self.traffic = Traffic(
                kernel,
                controls,
                drones,
                airspace,
                apart=apart,
                slack=slack,
                max_airborne=max_airborne,
            )
        self.navigation = Pilots(kernel, controls, drones, airspace, self.traffic, ledger, leaving)
        self.envelope = Envelope(airspace)
        self.drones, self._airspace, self._apart = tuple(drones), airspace, apart
        self._keys = {drone.id: FLEET + 1 + drone.index for drone in drones}
        self.jobs = Jobs(kernel, self.navigation.fly, self._keys, self.envelope, ledger)
        self._link: Link | None = None
        self.line: Callable[[Report], Report] | None = None
        """What lies between a brain and its reports in a simulation: it wraps whoever hears them."""
        self._epoch = 0
        self.descent: Task[None] | None = None
        """Brings all drones down, while that is so."""
        self._how = Down.LAND
        self._over = False
        self._heard = kernel.now
        if patience is not None:
            self._watch(patience)

    # Who commands

    def link(self, epoch: int, lost: Callable[[], object] | None = None) -> Link:
        """Let a brain command; whoever did so before does not any more.

        `lost` is told, once, when this link is cut in turn.
        """
        if epoch < self._epoch:
            raise BadInput("another run of this app has taken over the drones meanwhile")
        self.cut()
        self._epoch, self._heard = epoch, self.kernel.now
        self._link = link = Link(self, lost)
        return link

    def cut(self) -> None:
        """Let nobody command. Jobs go on; what else the drones do for the brain is broken off."""
        link, self._link = self._link, None
        if link is not None:
            self.jobs.mute()
            link.cut()

    @property
    def commander(self) -> Link | None:
        """The link through which the drones are commanded now."""
        return self._link

    def is_commanded_by(self, link: Link) -> bool:
        """Say whether this is the link through which the drones are commanded."""
        return link is self._link

    def break_off(self, drone: str) -> None:
        """Stop whatever a drone does, and hover."""
        self.jobs.break_off(drone)
        self.navigation.break_off(drone)

    # Without a brain

    def hear(self) -> None:
        """The brain is alive."""
        self._heard = self.kernel.now

    @property
    def flies(self) -> bool:
        """Whether any drone is in the air."""
        return any(not known.landed for known in self.navigation.telemetry.values())

    def _watch(self, patience: float) -> None:
        """Land everything when nothing was heard for too long; look again when that may be so."""
        if self._over:
            return
        due = self._heard + patience
        if self.kernel.now >= due:
            due = self.kernel.now + patience
            if self.descent is None and self.flies:
                self.fail_safe(Down.LAND)
        self.kernel.schedule(due, Kind.CLOCK, FLEET, partial(self._watch, patience))

    def fail_safe(self, how: Down) -> Task[None]:
        """Bring all drones down without the brain, which is cut off."""
        self.cut()
        return self.bring_down(how)

    def crash(self) -> None:
        """End as a process that is killed: the drones hover, and what is in memory is gone."""
        self._over = True
        self.jobs.leave()
        if self.descent is not None:
            self.descent.cancel()
        self.cut()
        for drone in self.drones:
            self.navigation.break_off(drone.id)

    async def cut_motors(self, drone: str) -> str:
        """Switch a drone's motors off now, whoever commands it; say why if it cannot be told."""
        try:
            await self.navigation.cut_motors(drone)
        except FlightFailed as error:
            return str(error)
        return ""

    # All drones

    async def call(self) -> FleetReport:
        """Ask every drone how it stands, and settle by that what has become of every job."""
        spawn = self.kernel.spawn
        asked = [
            spawn(self._ask(drone), key, f"{drone} is asked") for drone, key in self._keys.items()
        ]
        drones = {drone: await task for drone, task in zip(self._keys, asked, strict=True)}
        return FleetReport(drones=drones, jobs=self.jobs.settle(drones, self._epoch > 1))

    async def _ask(self, drone: str) -> DroneReport:
        standing = await self.navigation.roll_call(drone)
        if standing.reached:
            self.jobs.boots[drone] = standing.boot
        return standing

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight; it may have been switched off for that."""
        found = await self.navigation.recover(drone)
        if found:
            await self._ask(drone)
        return found

    def bring_down(self, how: Down) -> Task[None]:
        """Break off everything, and bring all drones down; the task is over when they are."""
        descent = self.descent
        if descent is not None:
            if self._how is Down.LAND or how is Down.HOME:
                return descent  # they come down no later than that
            descent.cancel()
        for drone in self.drones:
            self.break_off(drone.id)
        ways = Descent(self.kernel, self.navigation, self.drones, self._airspace, self.traffic)
        self._how = how
        self.descent = task = self.kernel.spawn(ways.down(how), FLEET, "all drones come down")
        task.over = self._is_down
        return task

    def _is_down(self, task: Task[None]) -> None:
        if self.descent is task:
            self.descent = None
        if task.error is not None and not isinstance(task.error, Cancelled):
            self.kernel.crash(task.error)
