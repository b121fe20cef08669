"""The socket between brain and gateway: orders and what is told of them, one JSON object per line."""

from __future__ import annotations

import time
from collections.abc import Container
from math import isinf
from typing import TYPE_CHECKING, Any

import msgspec

from ..jobs.reports import Down
from ..shared.domain.errors import BadInput
from ..shared.domain.model import Item, Point
from ..shared.domain.text import shown

if TYPE_CHECKING:
    from ..jobs.link import Order
    from ..jobs.telemetry import Telemetry
    from ..process.ipc import Message

STALE_AFTER = 2.0
"""Seconds without a message after which a drone's position is stale."""
MAX_COMMAND = 256 * 1024
"""Bytes of a line that the gateway reads."""
MAX_REPORT = 256 * 1024 * 1024
"""Bytes of a line that the brain reads: a fleet's report has all jobs of a large plan."""


def order_of(message: Message, drones: Container[str]) -> Order:
    """Return an order that came over the socket, if it is one, for one of these drones.

    Else raise `BadInput`, `KeyError` or `ValueError`.
    """
    facts = _FACTS.get(message["do"])
    if facts is None:
        raise BadInput(f"this gateway cannot {shown(message['do'])}")
    for name in facts:
        msgspec.convert(message[name], _TYPES[name])
    if "drone" in facts and message["drone"] not in drones:
        raise BadInput(f"there is no drone {shown(message['drone'])}")
    return message


_TYPES: dict[str, Any] = {
    "id": int | str,
    "order": int | str,
    "drone": str,
    "flight": str,
    "stops": list[Point],
    "action": str | None,
    "parameters": dict[str, bool | int | float | str],
    "item": Item | None,
    "seconds": float,
    "beside": bool,
    "name": str,
    "value": float,
    "kind": str,
    "job": str | None,
    "joining": dict[str, Any],
    "how": Down,
}
"""What each fact of an order must be."""

_FACTS: dict[object, tuple[str, ...]] = {
    "fly": ("id", "drone", "flight", "stops", "action", "parameters", "item", "seconds", "beside"),
    "redirect": (
        "id",
        "drone",
        "flight",
        "stops",
        "action",
        "parameters",
        "item",
        "seconds",
        "beside",
    ),
    "go": ("id", "drone", "stops", "seconds"),
    "act": ("id", "drone", "action", "parameters"),
    "sees": ("id", "drone"),
    "attach": ("id", "flight"),
    "cancel": ("order",),
    "heartbeat": (),
    "break_off": ("drone",),
    "mended": ("drone",),
    "forget": ("flight",),
    "hold": ("id", "drone"),
    "home": ("id", "drone"),
    "land": ("id", "drone"),
    "recover": ("id", "drone"),
    "read": ("id", "drone", "name"),
    "write": ("id", "drone", "name", "value"),
    "report": ("id", "drone"),
    "call": ("id",),
    "join": ("id", "joining"),
    "mishap": ("id", "drone", "kind", "job"),
    "down": ("id", "how"),
}
"""What each order must say."""


def seen(telemetry: Telemetry, moves: bool) -> tuple[object, ...]:
    """Return a drone's telemetry in a compact form, and whether it carries out a command.

    The last element is since when it is silent, in seconds since 1970; None if it is not, 0 if it has
    never sent anything.
    """
    silence, since = telemetry.silence, None
    if silence > STALE_AFTER:
        since = 0.0 if isinf(silence) else round(time.time() - silence)
    return *telemetry.location, telemetry.battery_level, telemetry.landed, moves, since
