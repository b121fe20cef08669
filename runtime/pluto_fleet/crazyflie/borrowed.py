"""What is used of cflib, and nothing else of it: imported when a radio is opened, never before.

cflib is published under the GPL, version 3; what is written here are only the names of its parts.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from threading import Lock, Thread
from typing import Protocol

from plutoc_runtime.domain.errors import BadInput

from ..drones.errors import NotReady
from ..scaffolding import app_package
from . import words

_LOADING = Lock()

HIGH_LEVEL, SUPERVISOR, LOCALIZATION, PLATFORM, LINK_CONTROL = 8, 9, 6, 13, 15
"""Ports."""


class Caller(Protocol):
    """A list of functions that are called when something happens, in one of cflib's threads."""

    def add_callback(self, call: Callable[..., None]) -> None: ...


class Packet(Protocol):
    """What goes to and fro."""

    data: bytes

    @property
    def channel(self) -> int: ...

    def set_header(self, port: int, channel: int) -> None: ...


class Element(Protocol):
    """A log variable or a parameter, as a table of contents has it."""

    ctype: str
    pytype: str


class Toc(Protocol):
    """A table of contents: names by group."""

    toc: Mapping[str, Mapping[str, Element]]


class LogConfig(Protocol):
    """Variables that are told together, every so often."""

    data_received_cb: Caller
    added: bool
    """Whether the drone has it."""

    def add_variable(self, name: str) -> None: ...

    def start(self) -> None: ...

    def delete(self) -> None: ...


class Log(Protocol):
    """The variables of a drone."""

    toc: Toc | None

    def add_config(self, logconf: LogConfig) -> None: ...


class Parameters(Protocol):
    """The parameters of a drone."""

    toc: Toc
    values: Mapping[str, Mapping[str, str]]

    def add_update_callback(
        self, group: str, name: str, cb: Callable[[str, str], None]
    ) -> None: ...

    def remove_update_callback(
        self, group: str, name: str, cb: Callable[[str, str], None]
    ) -> None: ...

    def request_param_update(self, complete_name: str) -> None: ...

    def set_value(self, complete_name: str, value: float) -> None: ...


class HighLevel(Protocol):
    """The commander that flies a course by itself."""

    def takeoff(
        self, absolute_height_m: float, duration_s: float, *, yaw: float | None
    ) -> None: ...

    def land(self, absolute_height_m: float, duration_s: float, *, yaw: float | None) -> None: ...

    def go_to(self, x: float, y: float, z: float, yaw: float, duration_s: float) -> None: ...

    def stop(self) -> None: ...


class LowLevel(Protocol):
    """The commander that takes set-points one by one: it is only ever told that there are none."""

    def send_notify_setpoint_stop(self) -> None: ...


class Supervisor(Protocol):
    """The part of the firmware that permits and forbids."""

    def send_arming_request(self, do_arm: bool) -> None: ...

    def send_crash_recovery_request(self) -> None: ...

    def send_emergency_stop(self) -> None: ...


class Platform(Protocol):
    """What the drone is."""

    def get_protocol_version(self) -> int: ...

    def send_user_notification(self, success: bool) -> None: ...


class ExternalPosition(Protocol):
    """Where somebody else sees it."""

    def send_extpos(self, x: float, y: float, z: float) -> None: ...


class Statistics(Protocol):
    """How good the link is: pings, which nobody asks for here."""

    def stop(self) -> None: ...


class Incoming(Protocol):
    """The thread that takes what comes."""

    def stop(self) -> None: ...

    def is_alive(self) -> bool: ...

    def join(self, timeout: float) -> None: ...


class Link(Protocol):
    """A driver: radio, USB or UDP."""

    needs_resending: bool

    def close(self) -> None: ...


class Cf(Protocol):
    """One drone, for one connection."""

    connected: Caller
    fully_connected: Caller
    connection_failed: Caller
    connection_lost: Caller
    disconnected: Caller
    link_established: Caller
    link: Link | None
    incoming: Incoming
    log: Log
    param: Parameters
    high_level_commander: HighLevel
    commander: LowLevel
    supervisor: Supervisor
    platform: Platform
    extpos: ExternalPosition
    link_statistics: Statistics

    def open_link(self, link_uri: str) -> None: ...

    def close_link(self) -> None: ...

    def send_packet(self, pk: Packet) -> None: ...

    def add_port_callback(self, port: int, cb: Callable[[Packet], None]) -> None: ...


class Radio(Protocol):
    """A dongle, as one of its users sees it."""

    def set_address(self, address: tuple[int, ...]) -> None: ...

    def set_data_rate(self, dr: int) -> None: ...

    def set_arc(self, arc: int) -> None: ...

    def scan_channels(self, start: int, stop: int, packet: tuple[int, ...]) -> tuple[int, ...]: ...

    def close(self) -> None: ...


class Radios(Protocol):
    """The dongles of this computer."""

    @staticmethod
    def open(devid: int) -> Radio: ...

    @staticmethod
    def remove(devid: int) -> None: ...


class MakesCf(Protocol):
    """The class of drones."""

    def __call__(self, *, rw_cache: str | None) -> Cf: ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Borrowed:
    """All of it."""

    crazyflie: MakesCf
    log_config: Callable[[str, int], LogConfig]
    packet: Callable[[], Packet]
    radios: Radios

    def forget_dead_radios(self) -> None:
        """Let a dongle be opened anew whose thread has ended: it was unplugged."""
        known: list[Thread | None] = getattr(self.radios, "_radios", [])
        for place, radio in enumerate(known):
            if radio is not None and not radio.is_alive():
                self.radios.remove(place)


def require() -> None:
    """Raise `BadInput` with the line that installs it, where there is no cflib; imports nothing."""
    if find_spec("cflib") is None:
        raise BadInput(words.no_cflib(_package()))


def borrowed() -> Borrowed:
    """Import what is needed; takes a second, and is called in a thread of its own."""
    with _LOADING:
        try:
            crtp = import_module("cflib.crtp")
            crazyflie = import_module("cflib.crazyflie").Crazyflie
            log_config = import_module("cflib.crazyflie.log").LogConfig
            packet = import_module("cflib.crtp.crtpstack").CRTPPacket
            radios = import_module("cflib.crtp.radiodriver").RadioManager
        except ImportError as error:
            raise NotReady(f"{words.no_cflib(_package())} ({error})") from error
        # what goes wrong is said here, in our words
        logging.getLogger("cflib").addHandler(logging.NullHandler())
        if not crtp.CLASSES:  # once a process: each time adds all drivers
            crtp.init_drivers()
        return Borrowed(crazyflie=crazyflie, log_config=log_config, packet=packet, radios=radios)


def _package() -> str | None:
    """Return the package whose extra brings cflib, or None where this lies in no such package."""
    package = app_package()
    return None if package == "pluto_fleet" else package
