"""The process in which MAVSDK runs, apart from the gateway: it decides nothing, and passes on what is asked and told.

It is a process of its own as MAVSDK aborts the one in which it is destroyed at the wrong moment, and as its heartbeats
go on while ours hangs: a vehicle would believe that a ground station watches it. So this process ends when the gateway says
nothing for a while, and the vehicles' own failsafes act.

Lines of JSON: it is asked on its standard input, and answers and tells on its standard output.
"""

from __future__ import annotations

import asyncio
import json
import os
import shutil
import sys
import tempfile
import time
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import count
from typing import Any, NoReturn

from mavsdk.asyncio import Configuration, Mavsdk
from mavsdk.asyncio.plugins.camera import CameraAsync
from mavsdk.asyncio.plugins.geofence import GeofenceAsync
from mavsdk.asyncio.plugins.mavlink_direct import MavlinkDirectAsync
from mavsdk.asyncio.plugins.param import ParamAsync
from mavsdk.asyncio.plugins.telemetry import TelemetryAsync
from mavsdk.autopilot import Autopilot
from mavsdk.component_type import ComponentType
from mavsdk.exceptions import MavsdkError
from mavsdk.logging import LogLevel, log_subscribe
from mavsdk.plugins.geofence import FenceType, GeofenceData, Point, Polygon
from mavsdk.plugins.mavlink_direct import MavlinkMessage

COMMAND = "mavsdk"

PATIENCE = 3.0
"""Seconds without a word of the gateway after which this process ends, and its heartbeats with it."""
_AT_ONCE = 64
"""Requests that wait for answers of vehicles at the same time, each in a thread."""
_LOOK = 0.1
_AUTOPILOT = 1
"""The component of a vehicle that flies it."""
RATES = {33: 10.0, 245: 5.0, 1: 1.0, 147: 1.0, 242: 0.5, 251: 10.0}
"""How often a second these are to be told: GLOBAL_POSITION_INT, EXTENDED_SYS_STATE, SYS_STATUS, BATTERY_STATUS,
HOME_POSITION, NAMED_VALUE_FLOAT. An ArduPilot tells none of them unasked but the last, which a PX4 tells once a second,
whatever it has then."""
_SET_INTERVAL = 511
_CAPTURE = 2000
_NO_HEADING = 65535

Message = Mapping[str, Any]


@dataclass(slots=True)
class Opened:
    """A vehicle that is told of."""

    system: Any
    direct: Any
    params: Any
    cameras: Any
    fences: Any
    told: list[asyncio.Task[None]] = field(default_factory=list)


class Desk:
    """Does what is asked."""

    def __init__(self, tell: Callable[[Message], None]) -> None:
        self._tell = tell
        self._links: dict[str, asyncio.Task[Any]] = {}
        self._open: dict[int, Opened] = {}
        self._captures = count(int(time.time()) % 1_000_000 + 1)
        """Numbers of pictures, others than before a restart."""

    async def answer(self, asked: Message) -> None:
        """Do it, and tell what came of it."""
        try:
            value = await getattr(self, f"do_{asked['do']}")(asked)
            self._tell({"answer": asked["ask"], "value": value})
        except (MavsdkError, OSError, TimeoutError, RuntimeError, KeyError, ValueError) as error:
            self._tell({"answer": asked["ask"], "error": _reason(error)})

    async def do_open(self, asked: Message) -> Message:
        """Find a vehicle's autopilot, and tell of it from now on under a number."""
        number = asked["vehicle"]
        link = asked["link"]
        system = asked["system"]
        found = await self._system(link, system)
        await self.do_close(asked)
        opened = Opened(
            system=found,
            direct=MavlinkDirectAsync(found),
            params=ParamAsync(found),
            cameras=CameraAsync(found),
            fences=GeofenceAsync(found),
        )
        self._open[number] = opened
        self._follow(number, opened, TelemetryAsync(found))
        for (
            kind,
            rate,
        ) in RATES.items():  # one by one: an answer says which command, and not which of several
            await self._ask_for(opened, system, kind, rate)
        make = await found.autopilot_type()
        return {"make": Autopilot(make).name.lower()}

    async def _system(self, link: str, number: int) -> Any:
        """Return a system with this number that has an autopilot: not a camera's, nor another station's."""
        mavsdk = await self._mavsdk(link)
        while True:
            for one in await mavsdk.get_systems():
                alive = await one.has_autopilot() and await one.is_connected()
                if alive and await one.get_system_id() == number:
                    return one
            await asyncio.sleep(_LOOK)

    async def _mavsdk(self, link: str) -> Any:
        """Return what has a connection open, for all vehicles behind it."""
        if link not in self._links:
            self._links[link] = asyncio.ensure_future(_connected(link))
        try:
            return await asyncio.shield(self._links[link])
        except MavsdkError:
            del self._links[link]  # such as a device that is not there yet
            raise

    async def do_scan(self, asked: Message) -> list[int]:
        """Listen for a while; return the system ids of all autopilots that were heard."""
        mavsdk = await self._mavsdk(asked["link"])
        await asyncio.sleep(asked["listens"])
        return sorted(
            [
                await one.get_system_id()
                for one in await mavsdk.get_systems()
                if await one.has_autopilot() and await one.is_connected()
            ]
        )

    async def _ask_for(self, opened: Opened, system: int, kind: int, rate: float) -> None:
        """Ask for a message so often; what does not come is noticed by who waits for it."""
        fields = {"command": _SET_INTERVAL, "param1": kind, "param2": 1e6 / rate}
        with suppress(MavsdkError, RuntimeError):
            await _command(opened, system, "COMMAND_LONG", fields)

    def _follow(self, number: int, opened: Opened, told: Any) -> None:
        def tell(kind: str, facts: Any) -> None:
            self._tell({"vehicle": number, "told": kind, "facts": facts})

        def on_position(one: Any) -> None:
            if one.component_id == _AUTOPILOT:
                tell("position", _position(json.loads(one.fields_json)))

        def on_battery(one: Any) -> None:
            tell("battery", {"volts": one.voltage_v, "percent": one.remaining_percent})

        def on_heartbeat(one: Any) -> None:
            if one.component_id == _AUTOPILOT:
                fields = json.loads(one.fields_json)
                tell("beat", {"mode": fields["custom_mode"], "base": fields["base_mode"]})

        def on_health(one: Any) -> None:
            tell("health", {name: bool(value) for name, value in vars(one).items()})

        def on_home(one: Any) -> None:
            tell("home", [one.latitude_deg, one.longitude_deg, one.absolute_altitude_m])

        def on_value(one: Any) -> None:
            fields = json.loads(one.fields_json)
            if fields["value"] is not None:
                tell("value", {"name": fields["name"], "value": fields["value"]})

        def on_text(one: Any) -> None:
            tell("text", {"severity": int(one.type), "text": one.text})

        def on_photo(one: Any) -> None:
            at = one.position
            place = [at.latitude_deg, at.longitude_deg]
            heights = [at.absolute_altitude_m, at.relative_altitude_m]
            taken = {"success": one.is_success, "index": one.index, "file": one.file_url}
            tell("photo", {"place": place, "heights": heights, **taken})

        opened.told = [
            asyncio.ensure_future(_each(stream, hear))
            for stream, hear in (
                (opened.direct.subscribe_message("GLOBAL_POSITION_INT"), on_position),
                (told.subscribe_battery(), on_battery),
                (told.subscribe_health(), on_health),
                (told.subscribe_home(), on_home),
                (told.subscribe_status_text(), on_text),
                (told.subscribe_landed_state(), lambda one: tell("landed", int(one))),
                (opened.direct.subscribe_message("HEARTBEAT"), on_heartbeat),
                (opened.direct.subscribe_message("NAMED_VALUE_FLOAT"), on_value),
                (opened.cameras.subscribe_capture_info(), on_photo),
                (
                    opened.cameras.subscribe_camera_list(),
                    lambda one: tell("cameras", [_lens(camera) for camera in one.cameras]),
                ),
            )
        ]

    async def do_close(self, asked: Message) -> None:
        opened = self._open.pop(asked["vehicle"], None)
        if opened is not None:
            for task in opened.told:
                task.cancel()
            await asyncio.gather(*opened.told, return_exceptions=True)

    async def do_command(self, asked: Message) -> int:
        """Send a command, again until it is answered; return the answer, a MAV_RESULT."""
        opened = self._open[asked["vehicle"]]
        return await _command(opened, asked["system"], asked["message"], asked["fields"])

    async def do_photo(self, asked: Message) -> int:
        """Have a camera take a picture, once, however often it is told; return the answer, a MAV_RESULT.

        MAVSDK's own call numbers its first capture 0, which cameras take for none.
        """
        fields = {
            "command": _CAPTURE,
            "target_component": asked["camera"],
            "param1": 0,
            "param2": 0,
            "param3": 1,
            "param4": next(self._captures),
        }
        opened = self._open[asked["vehicle"]]
        return await _command(opened, asked["system"], "COMMAND_LONG", fields)

    async def do_fence(self, asked: Message) -> None:
        """Give it a fence in place of its own: it must stay within these corners."""
        corners = [Point(latitude, longitude) for latitude, longitude in asked["corners"]]
        fence = GeofenceData([Polygon(corners, FenceType.INCLUSION)], [])
        await self._open[asked["vehicle"]].fences.upload_geofence(fence)

    async def do_read(self, asked: Message) -> float:
        """Read a parameter, of whichever type; of one that there is not nothing is told."""
        params = self._open[asked["vehicle"]].params
        name = asked["name"]
        try:
            return float(await params.get_param_float(name))
        except MavsdkError as error:
            if _reason(error) == "TIMEOUT":
                raise
        return float(await params.get_param_int(name))

    async def do_write(self, asked: Message) -> None:
        params = self._open[asked["vehicle"]].params
        name = asked["name"]
        try:
            await params.set_param_float(name, asked["value"])
        except MavsdkError:
            await params.set_param_int(name, int(asked["value"]))


def _reason(error: Exception) -> str:
    said = getattr(getattr(error, "result", None), "name", "") or str(error)
    return said or type(error).__name__


async def _connected(link: str) -> Any:
    settings = Configuration.create_with_component_type(ComponentType.GROUND_STATION)
    mavsdk = await asyncio.to_thread(Mavsdk, settings)
    await mavsdk.add_any_connection(link)
    return mavsdk


async def _command(opened: Opened, system: int, message: str, fields: Message) -> int:
    whole: dict[str, Any] = {"target_system": system, "target_component": _AUTOPILOT}
    if message == "COMMAND_LONG":
        whole |= {"confirmation": 0, **{f"param{number}": None for number in range(1, 8)}}
    else:
        whole |= {"current": 0, "autocontinue": 0, "param3": 0, "param4": None}
    whole |= fields
    text = json.dumps(whole)  # null is a number that is not given
    asked = MavlinkMessage(message, 0, 0, system, whole["target_component"], text)
    told = await opened.direct.send_command(asked)
    return int(json.loads(told.fields_json)["result"])


def _position(told: Message) -> Message:
    """Return a GLOBAL_POSITION_INT in degrees, metres and seconds; its heading is None if it has none."""
    heading = told["hdg"]
    return {
        "clock": told["time_boot_ms"],
        "place": [told["lat"] / 1e7, told["lon"] / 1e7],
        "heights": [told["alt"] / 1000, told["relative_alt"] / 1000],
        "velocity": [told["vx"] / 100, told["vy"] / 100, told["vz"] / 100],
        "heading": None if heading == _NO_HEADING else heading / 100,
    }


def _lens(camera: Any) -> Message:
    """Return what is known of a camera."""
    return {
        "component": camera.component_id,
        "name": f"{camera.vendor_name} {camera.model_name}".strip(),
        "focal": camera.focal_length_mm,
        "sensor": [camera.horizontal_sensor_size_mm, camera.vertical_sensor_size_mm],
    }


async def _each(stream: AsyncIterator[Any], hear: Callable[[Any], object]) -> None:
    async for one in stream:
        hear(one)


async def _run(out: int) -> None:
    loop = asyncio.get_running_loop()
    loop.set_default_executor(ThreadPoolExecutor(_AT_ONCE))

    def tell(message: Message) -> None:
        try:
            os.write(out, json.dumps(message).encode() + b"\n")
        except OSError:  # the gateway has ended
            _leave(0)

    desk = Desk(tell)
    asked = asyncio.StreamReader()
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(asked), sys.stdin)
    doing = set[asyncio.Task[None]]()
    while True:
        async with asyncio.timeout(PATIENCE):
            line = await asked.readline()
        if not line:
            return
        message = json.loads(line)
        if "do" in message:
            task = asyncio.ensure_future(desk.answer(message))
            doing.add(task)
            task.add_done_callback(doing.discard)


def _is_noise(level: LogLevel, _: str, file: str | None, __: int) -> bool:
    """Return whether a line of MAVSDK's log would only fill the gateway's: parameters are tried by either type."""
    return level < LogLevel.WARN or "param" in (file or "")


def main(_: Sequence[str]) -> int:
    """Serve the gateway until it has enough, or says nothing; never returns, as to destroy MAVSDK may abort."""
    os.environ["TMPDIR"] = tempfile.mkdtemp(prefix="pluto-mavsdk-")  # where it leaves its folders
    out = os.dup(1)
    os.dup2(2, 1)  # where MAVSDK and its wrappers print
    code = 0
    log_subscribe(_is_noise)
    try:
        asyncio.run(_run(out))
    except TimeoutError:
        print(
            "the gateway says nothing: no vehicle is told any more that it is watched",
            file=sys.stderr,
        )
        code = 1
    _leave(code)


def _leave(code: int) -> NoReturn:
    shutil.rmtree(os.environ["TMPDIR"], ignore_errors=True)
    sys.stderr.flush()
    os._exit(code)
