"""How each kind of drawing is read."""

from __future__ import annotations

from collections.abc import Callable

from . import feature, geojson, ground_station, kml, places_list

READERS: dict[str, Callable[[str], feature.Drawing]] = {
    feature.GEOJSON: geojson.read,
    feature.KML: kml.read,
    feature.PLAN: ground_station.read,
    feature.WAYPOINTS: ground_station.read_waypoints,
    feature.LIST: places_list.read,
}
"""By what messages call it."""
