"""The statuses of the drones: free, returning, charging, recovering, lost.

The only place where a drone's status changes, except at its allocation.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any, NamedTuple

from ..domain.errors import FlightFailed
from ..domain.keeper import put
from ..domain.model import AfterTrip
from ..domain.status import DroneStatus
from ..domain.text import cut_off, printable
from ..time.kernel import FLEET, EventKind, Future, Kernel, Key, Task
from .reach import LOW, docked

if TYPE_CHECKING:
    from ..domain.model import Drone, Point
    from ..domain.trace import Trace
    from .orders import Orders
    from .queue import Queue

Errand = Callable[["Drone"], Coroutine[Any, Any, None]]
"""What a drone does by itself: it returns, lands or recovers."""


class Loss(NamedTuple):
    """Why a drone is lost, and where it was then."""

    reason: str
    at: Point | None


class Fleet:
    """The drones of one app."""

    def __init__(
        self,
        kernel: Kernel,
        trace: Trace,
        orders: Orders,
        drones: list[Drone],
        queue: Queue,
        after_trip: AfterTrip,
    ) -> None:
        self.drones = drones
        self.queue = queue
        self._by_id = {drone.id: drone for drone in drones}
        self._kernel = kernel
        self._trace = trace
        self._orders = orders
        self._after_trip = after_trip
        self.errands: dict[Drone, Task[None]] = {}
        """The tasks of drones that return, land or recover."""
        self._change: Future[None] | None = None
        """Set at the next change of any drone, if something waits for it."""
        self.unready: dict[Drone, str] = {}  # drones that are lost, or not ready to fly, and why
        self.retired: set[Drone] = set()  # they are not allocated until they are brought back
        self.lost: dict[Drone, Loss] = {}
        """Drones that no trip may have before a person has looked after them."""
        self.mended: set[Drone] = set()
        """Drones that were lost and repaired, and are not back yet."""
        self.changed: Callable[[Drone], object] = lambda drone: None
        """Called when what must survive the app has changed of a drone."""
        queue.stay_out = after_trip is not AfterTrip.HOME
        queue.served = self._fetch_what_is_low

    def named(self, id: str) -> Drone | None:
        """Return the drone of this id, or None."""
        return self._by_id.get(id)

    def join(self, drone: Drone) -> None:
        """Take a new drone into the fleet."""
        self.drones.append(drone)
        self._by_id[drone.id] = drone
        self.changed(drone)

    def engage(self, drone: Drone) -> None:
        """End what a drone does by itself: it is about to fly for a mission."""
        self.unready.pop(drone, None)
        self.queue.homeward.discard(drone)
        errand = self.errands.pop(drone, None)
        if errand is not None:
            errand.cancel()

    def keep(self, drone: Drone, lose: Callable[[str], None]) -> None:
        """Land a drone with an item aboard where it is, to wait for its mission.

        If it cannot, its mission loses it: `lose` is told why.
        """

        async def land(drone: Drone) -> None:
            try:
                await self._orders.ask("land", drone.id)
            except FlightFailed as error:
                lose(str(error))
                await self.rescue(drone, str(error))

        self.send(drone, DroneStatus.BUSY, land, "waits with its item")

    def dismiss(self, drone: Drone) -> None:
        """Take a drone back whose trip has ended well."""
        if drone in self.retired:
            if not self._settle_here(drone):
                self.send_home(drone)
        elif (
            drone.telemetry.landed
            and drone.battery_level > drone.category.reserve
            and (self._after_trip is AfterTrip.STAY or docked(drone.location, drone.home))
        ):
            self.become(drone, _FREE)
        elif self._after_trip is AfterTrip.HOME or self.is_low(drone):
            self.send_home(drone)
        else:
            self.send(drone, DroneStatus.RETURNING, self._stay, "lands")

    def send_home(self, drone: Drone) -> None:
        """Send a drone home."""
        self.send(drone, DroneStatus.RETURNING, self.fly_home, "returns")

    def recover(self, drone: Drone, reason: str = "") -> None:
        """Recover a drone whose flight has failed: it is not allocated again before it is home."""
        rescue = partial(self.rescue, reason=reason)
        self.send(drone, DroneStatus.RECOVERING, rescue, "recovers")

    def never_flew(self, drone: Drone) -> None:
        """Take a drone back that was allocated and not launched."""
        self.send(drone, DroneStatus.BUSY, self._stay, "is not needed")

    def send(self, drone: Drone, status: DroneStatus, errand: Errand, what: str) -> None:
        self.engage(drone)
        self.become(drone, status)

        async def run() -> None:
            await errand(drone)
            del self.errands[drone]

        self.errands[drone] = self._kernel.spawn(run(), self._key(drone), f"{drone.id} {what}")

    def become(self, drone: Drone, status: DroneStatus) -> None:
        if drone.status is not status:
            put(drone, status=status)
            if self.mended and status in _SETTLED:
                self.mended.discard(drone)
            self.changed(drone)
            if self._trace.live:
                self._note(drone)
        self.queue.moved(drone)
        change = self._change
        if change is not None:
            self._change = None
            change.set(None)

    def _note(self, drone: Drone) -> None:
        at = [round(metres, 3) for metres in drone.location]
        facts: dict[str, object] = {"battery": round(drone.battery_level, 4), "at": at}
        if drone.status is DroneStatus.LOST:
            facts["reason"] = self.unready[drone]
        self._trace.note(f"drone.{drone.status.value.lower()}", drone=drone.id, **facts)

    # On the ground

    def _settle_here(self, drone: Drone) -> bool:
        """Make a healthy drone FREE, CHARGING or, if retired, OFFLINE; return False: it must go home for that."""
        reserve = drone.category.reserve
        level = drone.battery_level
        retired = drone in self.retired
        is_docked = self._is_docked(drone)
        if is_docked and drone.status in _UNDER_WAY and level < reserve - 0.005:
            self._trace.note("drone.drained", drone=drone.id, level=level)
        if level > reserve and not retired:
            self.become(drone, _FREE)
        elif not is_docked:
            return False
        elif retired:
            self.become(drone, DroneStatus.OFFLINE)
        elif drone.category.charge_time == inf:
            self.become(drone, _FREE)  # the queue puts it aside
        else:
            self.become(drone, DroneStatus.CHARGING)
            self._free_after(drone.charging(reserve) + 0.001, drone)
        return True

    def _free_after(self, seconds: float, drone: Drone) -> None:
        """Free a charging drone; if its battery is still low then, look at it again later."""

        def look() -> None:
            if drone.status is not DroneStatus.CHARGING:
                return
            if drone.battery_level > drone.category.reserve:
                self.become(drone, _FREE)
            else:
                self._free_after(10.0, drone)  # it should be charged by now

        self._kernel.at(self._kernel.now + seconds, EventKind.CLOCK, self._key(drone), look)

    async def _stay(self, drone: Drone) -> None:
        if self._after_trip is AfterTrip.ONWARD and not drone.telemetry.landed:
            for again in range(6):  # a hook may take half a second to say how its mission goes on
                if self.queue.waiting or not again:
                    put(drone, status=_FREE)  # for this instant alone
                    self._trace.note("drone.offered", drone=drone.id)
                    self.queue.moved(drone)
                    await self._kernel.sleep(0, EventKind.ALLOCATE, self._key(drone))
                    if drone.status is not _FREE:  # a mission has taken it
                        return
                    self.become(drone, DroneStatus.RETURNING)
                await self._kernel.sleep(0.1, EventKind.ALLOCATE, self._key(drone))
            await self.fly_home(drone)
            return
        if self._after_trip is AfterTrip.NEXT and not drone.telemetry.landed:
            if self.queue.waiting:  # the queue is served at the end of this instant
                await self._kernel.sleep(0, EventKind.ALLOCATE, self._key(drone))
            if not self.queue.waiting:
                await self.fly_home(drone)
                return
        try:
            await self._orders.ask("land", drone.id)
        except FlightFailed as error:
            await self.rescue(drone, str(error))
            return
        if not self._settle_here(drone):
            await self.fly_home(drone)
        while self._after_trip is AfterTrip.NEXT:
            await self._kernel.sleep(0, EventKind.ALLOCATE, self._key(drone))
            if drone.status is not _FREE or self._is_docked(drone):
                return
            if self.queue.room:
                await self.fly_home(drone)
                return
            self._change = self._change or Future()
            await self._change

    async def fly_home(self, drone: Drone) -> None:
        """Fly a drone home; one that lands beside its dock each time is lost there."""
        for _ in range(FLIGHTS_HOME):
            self.become(drone, DroneStatus.RETURNING)
            self.queue.homeward.add(drone)
            try:
                await self._orders.ask("home", drone.id)
            except FlightFailed as error:
                if not await self._recovered(drone, str(error)):
                    return
            if self._settle_here(drone):
                return
        away = f"{drone.distance(drone.home):.1f} m from its dock"
        self._lose(drone, f"it flew home {FLIGHTS_HOME} times, and landed {away}")

    async def rescue(self, drone: Drone, reason: str, repaired: bool = False) -> None:
        """Bring a drone home, or give it up as lost; a repaired one may say that it is not ready."""
        if await self._recovered(drone, reason, repaired) and not self._settle_here(drone):
            await self.fly_home(drone)

    async def _recovered(self, drone: Drone, reason: str, repaired: bool = False) -> bool:
        """Recover a drone; return False if it is lost."""
        self.become(drone, DroneStatus.RECOVERING)
        home = await self._orders.ask("recover", drone.id)  # true, or what a lost drone says
        if drone in self.lost:
            self._lose(drone, self.lost[drone].reason)
        elif home is not True:
            why = self._not_ready(drone, str(home or "")) if repaired else str(home or "")
            reason = cut_off(printable(reason), LONGEST) or "it could not be brought home"
            self._lose(drone, why or reason)
        else:
            self.unready.pop(drone, None)
        return drone.status is DroneStatus.RECOVERING

    def _lose(self, drone: Drone, reason: str) -> None:
        self.unready[drone] = reason
        x, y, z = (round(metres, 3) for metres in drone.location)
        self.lost.setdefault(drone, Loss(reason, (x, y, z)))
        self.become(drone, DroneStatus.LOST)

    # After an interruption, and when people look after drones

    def take_up(self, drone: Drone, report: Mapping[str, Any]) -> None:
        """Take over a drone that no mission needs now, when an app starts or resumes.

        It is allocated only once it is on the ground, healthy, with nothing aboard; a lost one only
        once it has been repaired, even if it reports to be healthy.
        """
        reached = report.get("reached", True)
        landed = report.get("landed", True)
        if drone in self.lost:
            if reached and not landed:
                self.recover(drone)  # it comes home, and stays lost
            else:
                self._lose(drone, self.lost[drone].reason)
            return
        why = self._not_ready(drone, "; ".join(report.get("problems", ())))
        well = reached and landed and not why and report.get("carrying") is None
        if well and self._settle_here(drone):
            return
        self.recover(drone, why or ("" if reached else f"{drone.id} does not answer"))
        if why and landed:
            self.unready[drone] = why

    def _not_ready(self, drone: Drone, why: str) -> str:
        """Note why a drone may not fly, if it says why, and return that."""
        why = cut_off(printable(why), LONGEST)
        if why and self._trace.live:
            self._trace.note("drone.not_ready", drone=drone.id, reason=why)
        return why

    def flies_on(self, drone: Drone) -> None:
        """Take over a drone that has been flying for a mission since before an interruption."""
        self.become(drone, DroneStatus.BUSY)

    def retire(self, drone: Drone) -> None:
        """Allocate this drone to no further mission; its current trip goes on to its end."""
        self.retired.add(drone)
        self.changed(drone)
        if drone.status in (_FREE, DroneStatus.CHARGING) and not self._settle_here(drone):
            self.send_home(drone)

    def bring_back(self, drone: Drone) -> None:
        """Make a retired drone available again; a lost one once it has come home."""
        self.retired.discard(drone)
        if self.lost.pop(drone, None) is not None:
            self.mended.add(drone)
        self.changed(drone)
        if drone.status is DroneStatus.LOST or drone in self.unready:
            self._orders.give({"do": "mended", "drone": drone.id})  # its errand may wait for this
        if drone.status is DroneStatus.LOST:
            unknown = "it was brought back, and could not be reached"
            back = partial(self.rescue, reason=unknown, repaired=True)
            self.send(drone, DroneStatus.RECOVERING, back, "comes back")
        elif drone.status is DroneStatus.OFFLINE and not self._settle_here(drone):
            self.send_home(drone)

    def _fetch_what_is_low(self) -> None:
        """Send home to charge the drones that missions wait for."""
        for drone in self.queue.too_low():
            if not self._is_docked(drone) and self.queue.room:
                self.send_home(drone)

    def is_low(self, drone: Drone) -> bool:
        """Whether its battery holds little more than the way home takes."""
        spare = 0.0 if self._after_trip is AfterTrip.ONWARD else LOW  # it is asked of each trip
        return drone.battery_level < drone.category.reserve + spare

    def _is_docked(self, drone: Drone) -> bool:
        return drone.telemetry.landed and docked(drone.location, drone.home)

    def _key(self, drone: Drone) -> Key:
        return FLEET + 1 + drone.index


_FREE = DroneStatus.FREE
_SETTLED = (DroneStatus.FREE, DroneStatus.CHARGING, DroneStatus.LOST)
"""With one of these a repair is settled."""
_UNDER_WAY = (DroneStatus.RETURNING, DroneStatus.RECOVERING)  # and not one that has stood there
FLIGHTS_HOME = 3  # how often a drone flies home that lands beside its dock, where it is not charged
LONGEST = 500  # characters of the reason why a drone is lost
