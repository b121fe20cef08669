"""What a vehicle does besides flying: it takes photos, measures by what it tells, and moves its gripper."""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import suppress
from math import isfinite
from statistics import fmean
from typing import Any
from urllib.parse import parse_qs, urlsplit

from ..drones.equipment import no_gripper, no_source, quantity_of
from ..drones.protocol import ActionNotDone, InView, LinkLost, Rejected
from ..shared.domain.actions import MEASURE, PHOTO, PICK, RELEASE, Plain
from ..shared.domain.model import Photo, Sighting
from ..shared.domain.text import quoted
from .makes import ACCEPTED, ANSWERS, IN_PROGRESS, NOT_NOW, Order, grips
from .mavsdk_client import NO_ANSWER
from .options import VehicleOptions
from .state import VehicleState

Ask = Callable[..., Awaitable[Any]]
"""Asks the process of MAVSDK for something: what, the time-out, and facts."""

CAMERA = 8.0
"""Seconds within which a camera must tell what it has taken."""
_SILENT = 5.0
"""Seconds without a value after which a sensor has fallen silent."""
_LOOK = 0.05
_GRIPPER = 15.0
"""Seconds within which a gripper must have got there."""
_PARAMETER = 6.0
"""The time-out of a parameter: of one that there is not nothing is told."""
_ANEW = 0.5
"""Seconds after which a command is given again that was in progress."""
_MOST_SEEN = 1000

_NONE = {"PX4": {"PD_GRIPPER_TYPE": -1.0}, "ArduPilot": {"GRIP_ENABLE": 0.0, "GRIP_TYPE": 0.0}}
"""By make: the parameters of a gripper, and the value of each that means that there is none."""
_USUAL = {"PD_GRIPPER_TYPE": 0, "GRIP_ENABLE": 1, "GRIP_TYPE": 1}
"""What they are for a servo."""


class Actions:
    """The actions of one vehicle, as configured in the fleet file."""

    def __init__(self, drone: str, options: VehicleOptions, ask: Ask, in_view: InView) -> None:
        self._drone = drone
        self._in_view = in_view
        self._options = options
        self._ask = ask
        self._photos: deque[asyncio.Future[Mapping[str, Any]]] = deque()
        """Those that were asked for, in their order."""
        self._no_gripper = ""
        """Why its autopilot moves none."""

    def hear(self, told: str, facts: Any) -> None:
        """Take what it tells, as far as it concerns an action."""
        if told == "photo" and self._photos:
            self._photos.popleft().set_result(facts)

    def are_heard(self, state: VehicleState) -> bool:
        """Return whether it has told each value that the fleet file names."""
        return all(name in state.values for name in self._options.measure.values())

    async def look(self, make: str) -> None:
        """Ask whether its autopilot is set up for a gripper, if it is to have one."""
        self._no_gripper = ""
        if self._options.grip is None:
            return
        for name, none in _NONE[make].items():
            try:
                is_there = await self._ask("read", _PARAMETER, name=name) != none
            except (LinkLost, Rejected):  # it has no such parameter
                is_there = False
            if not is_there:
                self._no_gripper = f"its {make} has no gripper: set {name} to {_USUAL[name]}"
                return

    def why_not(
        self, state: VehicleState | None, action: str, parameters: Mapping[str, Plain]
    ) -> str | None:
        """Return why it cannot do an action, or None; `state` is None before it is connected."""
        drone = self._drone
        options = self._options
        if action == MEASURE:
            quantity = quantity_of(parameters)
            name = options.name_of(quantity)
            if name is None:
                return no_source(drone, options.measure, quantity, "value", "name")
            if state is not None and name not in state.values:
                told = ", ".join(sorted(state.values)) or "none"
                return (
                    f"{drone} tells no value {quoted(name)} (NAMED_VALUE_FLOAT): it tells {told};"
                    f" start what tells it, or name another as its measure.{quantity} in the fleet file"
                )
            if state is not None and time.monotonic() - state.values[name][-1][0] > _SILENT:
                return self._silent(name)
            return None
        if action == PHOTO:
            if state is not None and not state.cameras:
                return f"{drone} has no camera that speaks MAVLink"
            return None
        if action in (PICK, RELEASE):
            if options.grip is None:
                return no_gripper(drone, "its gripper", "{ number = 1 }")
            return (
                f"{drone} cannot pick or release: {self._no_gripper}" if self._no_gripper else None
            )
        return f"{drone} is a MAVLink vehicle, which cannot {action}"

    async def act(
        self,
        state: VehicleState,
        system: int,
        action: str,
        parameters: Mapping[str, Plain],
        camera: float = CAMERA,
    ) -> object:
        """Do an action, and return its result; raise `ActionNotDone` if it failed.

        `camera`: seconds within which a camera must tell what it has taken.
        """
        if (why := self.why_not(state, action, parameters)) is not None:
            raise ActionNotDone(why)
        if action == MEASURE:
            name = self._options.name_of(quantity_of(parameters))
            assert name is not None  # else there is a reason why not
            return await self.mean(state, name, self._options.measure_seconds)
        if action == PHOTO:
            return await self._photo(state, system, camera)
        if action == PICK:
            await self._grip(system, close=False)  # as it comes, a PX4 has closed it already
        await self._grip(system, close=action == PICK)
        return None

    # What it measures

    async def mean(self, state: VehicleState, name: str, seconds: float) -> float:
        """Return a value's mean over some time; 0: the next one."""
        began = time.monotonic()
        await asyncio.sleep(seconds)
        while True:
            told = [value for at, value in state.values.get(name, ()) if at >= began]
            if told:
                return fmean(told)
            if time.monotonic() - began > seconds + _SILENT:
                raise ActionNotDone(self._silent(name))
            await asyncio.sleep(_LOOK)

    def _silent(self, name: str) -> str:
        return f"{self._drone} tells its value {quoted(name)} no more: see what has become of its sensor"

    # Its gripper

    async def _grip(self, system: int, *, close: bool) -> None:
        """Close or open it, and give it its time: that it has got there, no autopilot knows."""
        grip = self._options.grip
        assert grip is not None  # else there is a reason why not
        began = time.monotonic()
        order = grips(grip.number, close)
        while (result := await self._command(system, order)) == NOT_NOW:  # it is at it
            if time.monotonic() - began > _GRIPPER:
                break
            await asyncio.sleep(_ANEW)
        if result != ACCEPTED:
            said = ANSWERS.get(result, f"it answers {result}")
            moves = "close" if close else "open"
            raise ActionNotDone(f"{self._drone} does not {moves} its gripper: {said}")
        await asyncio.sleep(max(0.0, began + grip.seconds - time.monotonic()))

    async def _command(self, system: int, order: Order) -> int:
        try:
            told: int = await self._ask(
                "command", _GRIPPER, system=system, message=order.message, fields=order.fields
            )
        except (LinkLost, Rejected) as error:
            raise ActionNotDone(f"{self._drone} does not answer: {error}") from error
        return told

    # Its camera

    def sees(self, state: VehicleState) -> Sequence[Sighting]:
        """Return what the fleet's tracker sees in the view of its camera, which tells no more by itself."""
        if (why := self.why_not(state, PHOTO, {})) is not None:
            raise ActionNotDone(why)
        assert state.position is not None
        across, along = ground(state.cameras[0], state.position[2])
        return self._in_view(state.position, across, along)

    async def _photo(self, state: VehicleState, system: int, seconds: float) -> Photo:
        """Take a photo; that its camera has taken one, only its own message says."""
        lens = state.cameras[0]
        coming = asyncio.get_running_loop().create_future()
        self._photos.append(coming)
        try:
            async with asyncio.timeout(seconds):
                result = await self._ask("photo", seconds, camera=lens["component"], system=system)
                if result not in (ACCEPTED, IN_PROGRESS):
                    raise Rejected(ANSWERS.get(result, f"it answers {result}"))
                taken = await coming
        except TimeoutError as error:
            raise ActionNotDone(f"{self._drone}: its camera tells of no picture") from error
        except Rejected as error:
            said = "does not answer" if str(error) == NO_ANSWER else f"says: {error}"
            raise ActionNotDone(f"{self._drone}: its camera {said}") from error
        finally:
            with suppress(ValueError):  # it has come
                self._photos.remove(coming)
        if not taken["success"]:
            raise ActionNotDone(f"{self._drone}: its camera has taken no picture")
        place = state.point(taken)
        across, along = ground(lens, place[2])
        shown, sharpness = shown_at(taken["file"])
        tracks = self._in_view(place, across, along)
        sees = tuple(sorted([*shown, *(one.kind for one in tracks)]))
        return Photo(
            position=place,
            width=across,
            height=along,
            sees=sees,
            sharpness=sharpness,
            tracks=tracks,
        )


def ground(lens: Mapping[str, Any], height: float) -> tuple[float, float]:
    """Return how many metres of ground a camera sees from a height, across and along."""
    across, along = (height * size / (lens["focal"] or size) for size in lens["sensor"])
    return across, along


def shown_at(address: str) -> tuple[tuple[str, ...], float]:
    """Return what is on a picture and how sharp it is, as its camera may say behind its address.

    Such as `…/7.jpg?sharpness=0.8&sees=bloom*2,pest`; what it does not say is nothing, and 1.
    """
    try:
        said = parse_qs(urlsplit(address).query)
        sharpness = float(said.get("sharpness", ["1"])[0])
        found = list[str]()
        for one in filter(None, said.get("sees", [""])[0].split(",")):
            kind, _, times = one.partition("*")
            found += [kind] * min(_MOST_SEEN, int(times or 1))
    except ValueError:  # a query of another kind
        return (), 1.0
    return tuple(sorted(found)), sharpness if isfinite(sharpness) else 1.0
