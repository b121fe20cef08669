"""The navigation of a MAVLink vehicle: the public protocol, implemented with MAVSDK in a process of its own."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from contextlib import suppress
from math import dist
from typing import Any
from urllib.parse import quote

from ..drones.battery_gauge import BatteryGauge
from ..drones.protocol import (
    ACTS_BY_ITSELF,
    LINK_LOST,
    POSITION_LOST,
    ActionNotDone,
    DroneEvent,
    DroneSetup,
    DroneTelemetry,
    LinkLost,
    NavigationError,
    NotReady,
    OutsideArea,
    Rejected,
    TargetTimeout,
)
from ..drones.telemetry import Reports
from ..files.vehicle_addresses import SUCH_AS, VehicleAddress, vehicle_address
from ..geodesy import Degrees
from ..shared.domain.actions import MEASURE, PHOTO, Plain
from ..shared.domain.model import Item, Point, Sighting
from ..shared.domain.text import number
from .actions import Actions
from .makes import (
    ACCEPTED,
    ANSWERS,
    CUT_MOTORS,
    LAND_HERE,
    MAKES,
    Make,
    Order,
)
from .mavsdk_client import ENDED, NO_ANSWER, MavsdkClient, client
from .obedience import Change, Obedience
from .options import options_of
from .preflight import TWINS, problems
from .scanning import scan
from .settings import AutopilotSettings
from .state import ON_GROUND, VehicleState, is_armed

_FINDING = 12.0
"""Seconds in which a vehicle must be heard of: a heartbeat comes every second."""
_KNOWN = 3.0
"""Seconds in which it must then tell where it is, and how it is."""
_ANSWER = 6.0
"""Seconds for a command, which is sent again three times."""
_CAMERA_ON_THE_WAY = 4.0
"""Seconds within which a camera must tell what it has taken on the way: less than what an action there may take."""
_RESTS = 0.5
"""Seconds for which it must stay at its target, to have arrived."""
_HOME_SET = 0.15
"""Seconds after it was armed in which it sets its home anew, above which its heights are then."""
_LONGEST = 3600.0
_LANDING = 600.0
_HOLDING = 30.0
_DISARMING = 15.0
_CUTTING = 3.0
_RECENTLY = 5.0
"""Seconds within which a text says why its motors stopped, or why it acts by itself."""
_BEAT = 1.3
"""Seconds within which a heartbeat, and its reason, say that a vehicle refuses as it acts by itself."""
_REASON = 0.2
"""Seconds within which a text follows what it is the reason of."""


class MavlinkVehicle:
    """One vehicle, told apart by its system id from others behind the same address."""

    def __init__(self, setup: DroneSetup) -> None:
        self._id = setup.id
        self._setup = setup
        self._options = options_of(setup.options)
        self._reports = Reports(setup)
        self._has_stood_at_home = setup.folder / f"{quote(setup.id, safe='')}.stood-at-home"
        """Is there once it was where its home is on the map: from then on it may land elsewhere, and go on from there."""
        self._state = self._unknown()
        self._make: Make | None = None
        self._client: MavsdkClient | None = None
        self._number = 0
        self._actions = Actions(setup.id, self._options, self._ask, setup.in_view)
        self._settings = AutopilotSettings(setup, self._options, self._ask)
        self._crashed = ""
        self._cut = False
        self._obedience = Obedience()
        self._doubted = False
        """Whether its last heartbeat says that its motors are off, and is not believed yet."""
        self._mixed = False
        self._since = 0.0
        """Since when it has been where it is to be."""

    # The link

    async def connect(self) -> None:
        """Find its autopilot, and wait until it has told where it is and how it is."""
        await self._part()
        self._state = self._unknown()
        self._make = None
        self._mixed = False
        self._doubted = False
        address = self._address
        self._settings.forget()
        self._client = client()
        self._number = self._client.join(self._hear)
        try:
            found = await self._ask("open", _FINDING, link=address.link, system=address.system)
        except LinkLost:
            there = "nothing is heard there"
            with suppress(NavigationError):
                if heard := await self._ask("scan", _ANSWER, link=address.link, listens=0.0):
                    there = f"heard there: {', '.join(map(str, heard))}"
            raise LinkLost(
                f"{self._id}: no autopilot with the system id {address.system} at {address.place}; {there}"
            ) from None
        self._make = MAKES.get(found["make"])
        if self._make is None:
            makes = " nor ".join(one.name for one in MAKES.values())
            raise NotReady(f"{self._id}: its autopilot is neither {makes}")
        wanted = self._options.autopilot
        if wanted is not None and wanted != found["make"]:
            raise NotReady(f"{self._id}: its autopilot is {self._make.name}, and not {wanted}")
        began = time.monotonic()
        state = self._state
        while not state.is_known:
            if time.monotonic() - began > _KNOWN:
                raise LinkLost(f"{self._id} answers, and does not tell {self._untold()}")
            await asyncio.sleep(0.05)
        await self._actions.look(self._make.name)
        while time.monotonic() - began < _KNOWN and not self._has_told_all:
            await asyncio.sleep(0.05)  # its health is told once a second, and its camera asked for
        self._watch_mode()  # nothing may be ordered of one that returns by itself meanwhile
        self._tell()

    def _unknown(self) -> VehicleState:
        """Return the state of one of which nothing was heard."""
        cells = self._options.cells
        gauge = None if cells is None else BatteryGauge(cells)
        return VehicleState(self._setup.plane, self._setup.home[2], gauge)

    @property
    def _address(self) -> VehicleAddress:
        if self._setup.uri is None:
            raise NotReady(f"{self._id} has no uri in the fleet file, such as {SUCH_AS}")
        return vehicle_address(self._setup.uri)

    @property
    def _has_told_all(self) -> bool:
        state = self._state
        return state.is_well and bool(state.cameras) and self._actions.are_heard(state)

    def _untold(self) -> str:
        state = self._state
        if state.astray:
            return f"where on the map it is: it {state.astray}"
        missing = {
            "where it is": state.position is None,
            "its mode": not state.beaten,
            "whether it has landed": state.landed == 0,
        }
        return " and ".join(what for what, is_missing in missing.items() if is_missing)

    async def _part(self) -> None:
        if self._client is not None:
            former = self._client
            self._client = None
            await former.leave(self._number)

    async def close(self) -> None:
        """Part from it; if it flies by our command, it is landed first."""
        try:
            if self.telemetry.flying and self._client is not None:
                await self.land(1.0)
        except NavigationError:
            pass  # it cannot be reached: its own failsafe acts
        finally:
            await self._part()
            self._reports.close()

    @property
    def telemetry(self) -> DroneTelemetry:
        return self._reports.telemetry

    def events(self) -> AsyncIterator[DroneEvent]:
        return self._reports.events()

    def _hear(self, told: str, facts: Any) -> None:
        state = self._state
        if told == ENDED:
            self._client = None
            self._reports.happened(LINK_LOST, str(facts))
            return
        self._actions.hear(told, facts)
        if told == "beat" and self._doubts(facts):
            return
        flew = state.flying
        mode = state.mode
        lifted = state.lifted
        state.hear(told, facts)
        if self._make is None:
            return  # a slow one tells before it is known whose it is
        if flew and not state.flying:
            self._came_down(mode)
        if told == "beat":
            self._watch_mode()
        if told in ("position", "beat") and state.is_known:
            self._tell()
        if state.twins.are_there and not self._mixed:
            self._mixed = True
            self._obedience.by_itself = ""  # that may be the other one's mode
            self._reports.happened(POSITION_LOST, TWINS)
        if state.lifted and not lifted:
            moved = f"its home was set {number(round(abs(state.lifted), 1))} m"
            where = "higher" if state.lifted > 0 else "lower"
            self._reports.happened(POSITION_LOST, f"{moved} {where} in flight")

    def _doubts(self, beat: Mapping[str, Any]) -> bool:
        """Return whether a heartbeat is not believed until the next: that motors are off in flight, as if it had fallen.

        It may be that of another vehicle with its id.
        """
        state = self._state
        state.twins.beat(is_armed(beat))
        surprises = state.flying and not is_armed(beat) and not self._cut
        before = self._doubted
        self._doubted = surprises and (self._mixed or not self._may_land(state.mode))
        return self._doubted and not before

    def _tell(self) -> None:
        state = self._state
        assert state.position is not None
        self._reports.tell(
            position=state.position,
            flying=state.flying,
            yaw=state.yaw,
            voltage=state.volts,
            battery_level=state.battery,
            crashed=self._crashed,
        )

    def _came_down(self, mode: int) -> None:
        """Note a crash: its motors are off in the air, or on the ground where it was not to land."""
        state = self._state
        if self._cut:
            self._crashed = "its motors were cut"
        elif not self._mixed and (state.is_high or not self._may_land(mode)):
            said = state.since(time.monotonic() - _RECENTLY)
            self._crashed = f"its motors stopped{f' ({said})' if said else ''}"

    def _may_land(self, mode: int) -> bool:
        """Return whether motors that stop on the ground in this mode have landed it; a pilot lands it in any."""
        if self._make is None or self._obedience.by_itself:
            return True
        modes = self._make.modes
        return self._obedience.order == "land" or mode in modes["land"] | modes["return"]

    async def _ask(self, do: str, seconds: float, **facts: Any) -> Any:
        if self._client is None:
            raise LinkLost(f"{self._id} is not connected")
        try:
            return await self._client.ask(do, seconds, vehicle=self._number, **facts)
        except LinkLost as error:
            raise LinkLost(f"{self._id}: {error}") from None

    async def _order(self, what: str, orders: Sequence[Order], *, stays: bool = False) -> None:
        """Give the commands of an order one after the other; raise `Rejected` with what it says against one.

        Nothing is ordered of a vehicle that acts by itself: that would overrule its failsafe, or its pilot. `stays`: it
        is in the mode of the order already.
        """
        self._refuse_if_by_itself()
        began = time.monotonic()
        self._obedience.tell(what, began, obeys=stays)
        for order in orders:
            try:
                result = await self._ask(
                    "command",
                    _ANSWER,
                    system=self._address.system,
                    message=order.message,
                    fields=order.fields,
                )
            except Rejected as error:
                said = "" if str(error) == NO_ANSWER else f": {error}"
                raise LinkLost(f"{self._id} does not answer a command{said}") from None
            if result != ACCEPTED:
                await asyncio.sleep(_BEAT if self._state.flying else _REASON)
                self._refuse_if_by_itself()
                said = self._state.since(began) or ANSWERS.get(result, f"it answers {result}")
                raise Rejected(f"{self._id} refuses a command: {said}")

    @property
    def _known_make(self) -> Make:
        if self._make is None:
            raise LinkLost(f"{self._id} is not connected")
        return self._make

    # Flying

    async def preflight(self) -> Sequence[str]:
        if self._client is None:
            return [f"{self._id} is not connected"]
        if self._state.flying:
            return []
        if self._crashed:
            return [f"{self._crashed}, and nobody has looked after it since"]
        make = self._known_make.name
        await self._read_settings(make)
        if (why := self._settings.too_slow(make)) is not None:
            return [why]
        home = None if self._has_stood_at_home.exists() else self._setup.home
        if found := problems(self._state, home, self._options):
            return found
        why = await self._settings.fence_in(make)
        return [] if why is None else [why]

    async def _read_settings(self, make: str) -> None:
        """Read what it does by itself, and say it, once."""
        if await self._settings.look(make):
            does = self._settings.does(make)
            said = ", ".join(f"{when}: {what}" for when, what in does.items())
            self._reports.happened("failsafes", f"what it does by itself: {said}")

    async def takeoff(self, height: float, speed: float) -> None:
        """Take off straight up, at the speed that its autopilot has for that."""
        state = self._state
        if state.position is None:
            raise LinkLost(f"{self._id} is not connected")
        target = (state.position[0], state.position[1], height)
        if not state.flying:
            reasons = await self.preflight()
            if reasons:
                raise NotReady(f"{self._id} is not ready: {'; '.join(reasons)}")
            self._has_stood_at_home.touch()
            await self._rise(target)
        await self._until(lambda: self._is_at(target), _LONGEST)

    async def _rise(self, target: Point) -> None:
        """Arm it, and tell it to take off to a height above where it stands."""
        make = self._known_make
        await self._order("rise", make.arms())
        began = time.monotonic()
        await self._reports.until(lambda told: told.time - began > _HOME_SET, _LONGEST)
        try:
            await self._order("rise", make.rises(self._place(target)))
        except Rejected:
            # if its first answer was lost, an ArduPilot refuses what it does already
            with suppress(TargetTimeout):
                await self._reports.until(lambda _: self._state.flying, _BEAT)
            if not self._state.flying:
                raise

    async def go_to(self, target: Point, speed: float) -> None:
        await self._has_touched_down()
        self._reports.refuse(target, speed)
        make = self._known_make
        stays = self._obedience.is_in("go", self._state.mode, make.modes)
        await self._order("go", make.goes(self._place(target), speed, stays), stays=stays)
        await self._until(lambda: self._is_at(target), _LONGEST)

    async def hold(self) -> None:
        """Stop it here; one that acts by itself goes on with that."""
        if await self._has_touched_down():
            return
        if self.telemetry.flying and not self._obedience.by_itself:
            await self._order("hold", self._known_make.holds())
            await self._until(self._is_still, _HOLDING)

    async def _has_touched_down(self) -> bool:
        """Wait until one that has just landed has its motors off, and return whether it has: it flies nowhere before."""
        state = self._state
        if self._obedience.order == "land" and state.flying and state.landed == ON_GROUND:
            await self._reports.until(
                lambda _: not state.flying or state.landed != ON_GROUND, _DISARMING
            )
        return not state.flying

    async def land(self, speed: float) -> None:
        """Land straight down, at the speed that its autopilot has for that.

        One that acts by itself is waited for, until it or its pilot has landed it, or has given it back.
        """
        if not self.telemetry.flying:
            return
        if self._obedience.by_itself:
            await self._reports.until(
                lambda _: not (self._state.flying and self._obedience.by_itself), _LANDING
            )
        if not self._state.flying:
            return
        await self._order("land", [LAND_HERE])
        await self._until(lambda: not self._state.flying, _LANDING)

    async def emergency_stop(self) -> None:
        self._cut = True
        self._obedience.by_itself = ""
        await self._order("", [CUT_MOTORS])
        await self._reports.until(lambda _: not self._state.armed, _CUTTING)

    async def looked_after(self) -> None:
        """Believe that it is well again."""
        self._crashed = ""
        self._cut = False
        self._tell()

    def _place(self, target: Point) -> Any:
        try:
            return self._state.place(target)
        except ValueError as error:
            raise OutsideArea(f"{self._id}: the target {error}") from None

    async def _until(self, done: Callable[[], bool], seconds: float) -> None:
        """Wait until it is done, as long as the vehicle does what it was told."""
        self._since = 0.0

        def look(_: DroneTelemetry) -> bool:
            return bool(self._obedience.by_itself) or done()

        await self._reports.until(look, seconds)
        if mode := self._obedience.by_itself:
            await asyncio.sleep(_REASON)
            raise self._acts(self._obedience.by_itself or mode)

    def _watch_mode(self) -> None:
        """Notice a mode that it has taken by itself: our orders end there."""
        if self._mixed:
            return  # whose mode it is, is not known
        state = self._state
        make = self._known_make
        now = time.monotonic()
        if not state.flying:
            self._obedience.stand(now)
            return
        match self._obedience.look(state.mode, make.modes, now):
            case Change.LEAVES:
                self._obedience.by_itself = f"it is in the mode {make.mode_name(state.mode)}"
                asyncio.get_running_loop().call_later(_REASON, self._tell_by_itself, now)
            case Change.IS_BACK:
                self._reports.happened("given back", "it takes orders again, and lands first")

    def _tell_by_itself(self, began: float) -> None:
        if self._obedience.by_itself:
            said = self._state.since(began - _RECENTLY)
            self._obedience.by_itself += f" ({said})" if said else ""
            self._reports.happened(ACTS_BY_ITSELF, self._obedience.by_itself)

    def _refuse_if_by_itself(self) -> None:
        if self._obedience.by_itself:
            raise self._acts(self._obedience.by_itself)

    def _acts(self, why: str) -> Rejected:
        return Rejected(f"{self._id} acts by itself: {why}")

    def _is_at(self, target: Point) -> bool:
        position = self._state.position
        near = position is not None and dist(position, target) <= self._options.reach
        return self._lasts(near and self._is_slow)

    def _is_still(self) -> bool:
        return self._lasts(self._is_slow)

    @property
    def _is_slow(self) -> bool:
        return self._state.speed <= self._options.still

    def _lasts(self, holds: bool) -> bool:
        """Return whether something has been so for long enough."""
        now = time.monotonic()
        if not holds:
            self._since = 0.0
            return False
        self._since = self._since or now
        return now - self._since >= _RESTS

    # Optional abilities

    def why_not(self, action: str, parameters: Mapping[str, Plain]) -> str | None:
        state = None if self._client is None else self._state
        return self._actions.why_not(state, action, parameters)

    async def act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        return await self._actions.act(self._state, self._address.system, action, parameters)

    async def trigger(self, action: str, parameters: Mapping[str, Plain]) -> object:
        """Do an action on its way: it flies on meanwhile."""
        if action not in (MEASURE, PHOTO):
            raise ActionNotDone(f"{self._id} must stop to {action}")
        return await self._actions.act(
            self._state, self._address.system, action, parameters, _CAMERA_ON_THE_WAY
        )

    async def sees(self) -> Sequence[Sighting]:
        """Return what the fleet's tracker sees in the view of its camera."""
        return self._actions.sees(self._state)

    async def read(self, name: str) -> float:
        """Return a quantity, a value that it tells, or else a parameter of its autopilot."""
        told = self._options.name_of(name) or name
        if told in self._state.values:
            return await self._actions.mean(self._state, told, 0.0)
        try:
            return await self._settings.read(name)
        except Rejected:
            raise Rejected(f"{self._id} neither tells a value nor has a parameter {name}") from None

    async def write(self, name: str, value: float) -> None:
        """Set a parameter of its autopilot."""
        await self._settings.write(name, value)

    @property
    def degrees(self) -> Degrees | None:
        """Where it is: latitude, longitude, and altitude above sea level."""
        return self._state.degrees

    async def facts(self) -> Mapping[str, str]:
        make = self._known_make
        await self._read_settings(make.name)
        does = self._settings.does(make.name)
        mode = make.mode_name(self._state.mode)
        tells = ", ".join(sorted(self._state.values)) or "no values"
        return {"autopilot": make.name, "mode": mode, **does, "tells": tells}

    @staticmethod
    def canonical_uri(uri: str) -> str:
        return vehicle_address(uri).uri

    @staticmethod
    async def scan(options: Mapping[str, object]) -> Sequence[str]:
        return await scan(options_of(options).addresses)
