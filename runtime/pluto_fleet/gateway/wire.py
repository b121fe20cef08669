"""The socket between brain and gateway: orders and what is told of them, one JSON object per line."""

from __future__ import annotations

import time
from collections.abc import Callable, Container
from math import isinf
from typing import TYPE_CHECKING, Any

from ..jobs.reports import Down
from ..shared.domain.errors import BadInput
from ..shared.domain.text import shown
from ..shared.hooks.plain_data import item_of, point_of

if TYPE_CHECKING:
    from ..jobs.link import Order
    from ..jobs.telemetry import Telemetry
    from ..process.ipc import Message
    from ..shared.domain.model import Point

STALE_AFTER = 2.0
"""Seconds without a message after which a drone's position is stale."""
MAX_COMMAND = 256 * 1024
"""Bytes of a line that the gateway reads."""
MAX_REPORT = 256 * 1024 * 1024
"""Bytes of a line that the brain reads: a fleet's report has all jobs of a large plan."""


def order_of(message: Message, drones: Container[str]) -> Order:
    """Return an order that came over the socket, if it is one, for one of these drones.

    Else raise `BadInput`, `KeyError`, `OverflowError`, `TypeError` or `ValueError`.
    """
    facts = _FACTS.get(message["do"])
    if facts is None:
        raise BadInput(f"this gateway cannot {shown(message['do'])}")
    order = {**message, **{name: _CHECKED[name](message[name]) for name in facts}}
    if "drone" in facts and order["drone"] not in drones:
        raise BadInput(f"there is no drone {shown(order['drone'])}")
    return order


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{shown(value)} is no text")
    return value


def _text_or_none(value: object) -> str | None:
    return None if value is None else _text(value)


def _number(value: object) -> object:
    """Return the id of an order."""
    return value if type(value) is int else _text(value)


def _stops(value: Any) -> list[Point]:
    return [point_of([float(along) for along in stop]) for stop in value]


def _item(value: Any) -> object:
    item_of(value)
    return value


_CHECKED: dict[str, Callable[[Any], object]] = {
    "id": _number,
    "order": _number,
    "drone": _text,
    "flight": _text,
    "stops": _stops,
    "action": _text_or_none,
    "parameters": dict,
    "item": _item,
    "seconds": float,
    "beside": bool,
    "name": _text,
    "value": float,
    "kind": _text,
    "job": _text_or_none,
    "joining": dict,
    "how": lambda how: Down(how).value,
}
"""What returns each fact of an order as it must be."""

_FACTS: dict[object, tuple[str, ...]] = {
    "fly": ("id", "drone", "flight", "stops", "action", "parameters", "item", "seconds", "beside"),
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
