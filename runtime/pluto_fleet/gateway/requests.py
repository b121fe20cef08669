"""What a brain asks for that takes its time, and is answered when it is done."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from functools import partial
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import shown

from ..jobs.reports import Down
from .wire import Message, roll_data, standing_data

if TYPE_CHECKING:
    from .link import Link


def asked(
    link: Link, what: str, message: Message, known: Callable[[Any], str]
) -> Coroutine[Any, Any, object]:
    """Return what answers a message; `known` refuses drones that there are not."""
    if what == "call":
        return _as_data(roll_data, link.call)
    if what == "down":
        return link.bring_down(Down(message["how"]))
    drone = known(message["drone"])
    match what:
        case "hold":
            return link.hold(drone)
        case "read":
            return link.read(drone, str(message["name"]))
        case "write":
            return link.write(drone, str(message["name"]), float(message["value"]))
        case "takeoff":
            return link.takeoff(drone, float(message["height"]))
        case "go_to":
            x, y, z = map(float, message["target"])
            return link.go_to(drone, (x, y, z))
        case "land":
            return link.land(drone)
        case "recover":
            return link.recover(drone)
        case "roll_call":
            return _as_data(standing_data, partial(link.roll_call, drone))
        case _:
            raise BadInput(f"this gateway cannot {shown(what)}")


async def _as_data(
    write: Callable[[Any], object], ask: Callable[[], Coroutine[Any, Any, object]]
) -> object:
    return write(await ask())
