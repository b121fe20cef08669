"""What happens to a drone that nobody has asked for."""

from __future__ import annotations

import asyncio
from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.domain.text import place
from plutoc_runtime.time.kernel import WHATEVER

from .telemetry import BATTERY_LOW, CRASHED, LINK_LOST, LOCKED, POSITION_LOST
from .timeouts import shortened

if TYPE_CHECKING:
    from .telemetry import DroneEvent
    from .vehicle import Member

BETWEEN = 0.01
"""Seconds between two events: one that never ends to have news would let nobody else do anything."""


async def listen(member: Member) -> None:
    """Hear of all events of a drone, until it is let go of."""
    calls = member.calls
    try:
        events = member.navigation.events().__aiter__()
        while True:
            event = await calls.timed(events.__anext__())
            calls.ask("events", partial(hear, member, event), None)
            await asyncio.sleep(BETWEEN)
    except StopAsyncIteration:
        pass
    except (asyncio.CancelledError, KeyboardInterrupt):
        raise
    except WHATEVER as error:
        calls.mistake("events", error)


def hear(member: Member, event: DroneEvent) -> None:
    """Do what an event calls for."""
    kind, reason = str(event.kind), shortened(str(event.reason))
    who, where = member.id, place(member.seen.location)
    if kind == LINK_LOST:
        member.lost(reason)
    elif kind in (CRASHED, LOCKED) and member.flew_lately and not member.has_crashed:
        member.crashed(f"{who} {_BECAME[kind]} at {where}: {reason}")
    elif kind == BATTERY_LOW and not member.seen.landed and not member.must_land:
        why = f"the battery of {who} is low at {where}, where it lands: {reason}"
        member.must_come_down(FlightFailed(Failure.BATTERY, why))
    elif kind == POSITION_LOST and not member.seen.landed:
        member.loses_its_place(reason)
    else:
        member.calls.note(f"{who}: {shortened(kind)}: {reason}")


_BECAME = {CRASHED: "crashed", LOCKED: "was locked"}
