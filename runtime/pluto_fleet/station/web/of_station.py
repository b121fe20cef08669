"""All further addresses of a real station."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .map_addresses import map_addresses
from .plan_addresses import plan_addresses

if TYPE_CHECKING:
    from ..station import Station
    from .addresses import Addresses


def station_addresses(station: Station) -> Addresses:
    """Return them; a new room of addresses is added here."""
    return {
        **map_addresses(station.map, station.ways),
        **plan_addresses(station.plan, station.library),
    }
