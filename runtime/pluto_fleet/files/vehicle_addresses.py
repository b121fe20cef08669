"""The addresses of MAVLink vehicles: `mavlink+udp://:14540?system=3`.

With a host, a vehicle or a router is spoken to there; without one it is listened to at that port. Several vehicles
behind one address are told apart by their system ids. Needs no MAVSDK.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from urllib.parse import parse_qsl

from ..shared.domain.text import quoted

PREFIX = "mavlink+"
SUCH_AS = "mavlink+udp://:14540?system=1"
BAUD = 57_600
"""Of a telemetry radio as it comes (SiK)."""

_FORMS = {
    "udp": SUCH_AS,
    "tcp": "mavlink+tcp://192.168.1.7:5760?system=1",
    "serial": "mavlink+serial:///dev/ttyUSB0?baud=57600&system=1",
}
_KEYS = {"udp": ("system",), "tcp": ("system",), "serial": ("baud", "system")}
_NETWORK = re.compile(r"(?P<host>[A-Za-z0-9_.-]{0,255}):(?P<port>[0-9]{1,5})/?")
_DEVICE = re.compile(r"/[-A-Za-z0-9_/.:]+")
_WHOLE = re.compile(r"[0-9]{1,9}")


@dataclass(frozen=True, slots=True, kw_only=True)
class VehicleAddress:
    """How one vehicle is reached."""

    link: str
    """The connection that it shares with others, as MAVSDK writes it."""
    system: int
    """Its system id."""
    uri: str
    """In its canonical form: all that it left out is there."""

    @property
    def place(self) -> str:
        """The same without the system id: where all are that share the connection."""
        return re.sub(r"[?&]system=\d+$", "", self.uri)

    def uri_of(self, system: int) -> str:
        """Return the uri of another vehicle behind the same connection."""
        return f"{self.uri.rpartition('=')[0]}={system}"


def is_vehicle(uri: str) -> bool:
    """Return whether a uri is meant to be that of a MAVLink vehicle."""
    return uri.strip().lower().startswith(PREFIX)


def vehicle_address(uri: str) -> VehicleAddress:
    """Read an address; raise `ValueError` with what is wrong with it, to be said after the address."""
    scheme, marked, rest = uri.partition("://")
    kind = scheme.removeprefix(PREFIX)
    if not marked or not scheme.startswith(PREFIX) or kind not in _FORMS:
        begins = ", ".join(f"{PREFIX}{one}://" for one in _FORMS)
        raise ValueError(
            f"is no address of a MAVLink vehicle: it begins with {begins}; such as {SUCH_AS}"
        )
    place, _, query = rest.partition("?")
    options = _options(kind, query)
    system = _system(options.get("system", "1"))
    if kind == "serial":
        return _serial(place, options.get("baud", str(BAUD)), system)
    match = _NETWORK.fullmatch(place)
    if match is None:
        raise ValueError(f"names no host and port: write it like {_FORMS[kind]}")
    host = match["host"].lower()
    port = int(match["port"])
    if not 0 < port < 65536:
        raise ValueError(f"names no port, a number from 1 to 65535; write it like {_FORMS[kind]}")
    host = "127.0.0.1" if host == "localhost" else host
    way = "out" if host else "in"
    return VehicleAddress(
        link=f"{kind}{way}://{host or '0.0.0.0'}:{port}",
        system=system,
        uri=f"{PREFIX}{kind}://{host}:{port}?system={system}",
    )


def _options(kind: str, query: str) -> dict[str, str]:
    options = dict(parse_qsl(query, keep_blank_values=True))
    for key in options:
        if key not in _KEYS[kind]:
            raise ValueError(
                f"has {quoted(key)}, which it cannot have; write it like {_FORMS[kind]}"
            )
    return options


def _system(text: str) -> int:
    if not _WHOLE.fullmatch(text) or not 1 <= int(text) <= 254:
        raise ValueError(f"names the system {quoted(text)}: a vehicle has a number from 1 to 254")
    return int(text)


def _serial(device: str, baud: str, system: int) -> VehicleAddress:
    if not _DEVICE.fullmatch(device):
        raise ValueError(f"names no device: write it like {_FORMS['serial']}")
    if not _WHOLE.fullmatch(baud) or not 1200 <= int(baud) <= 3_000_000:
        raise ValueError(f"is no rate: baud={quoted(baud)}; a telemetry radio has {BAUD}")
    return VehicleAddress(
        link=f"serial://{device}:{int(baud)}",
        system=system,
        uri=f"{PREFIX}serial://{device}?baud={int(baud)}&system={system}",
    )
