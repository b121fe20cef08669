"""Which vehicles are there: the system ids that are heard of behind some addresses."""

from __future__ import annotations

from collections.abc import Sequence

from ..drones.protocol import LinkLost, Rejected
from ..files.vehicle_addresses import VehicleAddress, vehicle_address
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted
from .mavsdk_client import client

_LISTENS = 3.0
"""Seconds: a heartbeat comes every second."""
_WITHIN = 15.0


async def scan(addresses: Sequence[str]) -> list[str]:
    """Return the URIs of all vehicles that are heard of; raise `LinkLost` if no address can be listened at."""
    places = [_place(one) for one in addresses]
    desk = client()
    number = desk.join(lambda *_: None)
    found = list[str]()
    refused = list[str]()
    try:
        for place in places:
            try:
                there = await desk.ask("scan", _WITHIN, link=place.link, listens=_LISTENS)
            except (LinkLost, Rejected) as error:  # another program may have it
                refused.append(f"{place.place}: {error}")
                continue
            found += [place.uri_of(system) for system in there]
    finally:
        await desk.leave(number)
    if len(refused) == len(places):
        raise LinkLost("; ".join(refused) or "there is no address to listen at")
    return found


def _place(address: str) -> VehicleAddress:
    try:
        return vehicle_address(address)
    except ValueError as error:
        raise BadInput(f"{quoted(address)} {error}") from None
