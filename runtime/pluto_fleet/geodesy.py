"""Between degrees on the Earth and metres on a map: the map is a plane that touches the Earth at its origin.

By the usual formulas of the ellipsoid of WGS 84: geodetic coordinates, Earth-centred ones (ECEF), and east, north
and up at the origin. Degrees are known at the edges alone: in vehicles, in files of other programs, on the screen.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import atan2, cos, degrees, dist, hypot, isfinite, radians, sin, sqrt

Metres = tuple[float, float, float]
"""x, y and z on a map."""
Degrees = tuple[float, float, float]
"""Latitude and longitude in degrees, and an altitude in metres."""

REACH = 20_000.0
"""Metres from the origin: a plane is no map of the Earth farther away."""

_EQUATOR = 6_378_137.0
_FLATTENING = 1 / 298.257223563
_POLE = _EQUATOR * (1 - _FLATTENING)
_ECCENTRICITY = _FLATTENING * (2 - _FLATTENING)  # its square


@dataclass(frozen=True)
class LocalPlane:
    """A map's metres, and where they are on the Earth.

    `latitude` and `longitude` of the map's corner (0, 0) are in degrees of WGS 84. `bearing`, in radians, is the
    compass direction of the map's y axis, clockwise from true north; at 0, x goes east and y goes north.

    `altitude` is that of the map's z = 0, in metres above sea level, and so is every altitude here; z is the height
    above it, everywhere: what climbs straight up keeps its x and y, and what keeps its z keeps its altitude. Sea
    level may be that of any model of the geoid, or the ellipsoid itself, as long as it is the same one throughout.
    """

    latitude: float
    longitude: float
    altitude: float = 0.0
    bearing: float = 0.0

    def to_degrees(self, place: Metres) -> Degrees:
        """Return latitude, longitude and altitude of a place on the map, given in metres.

        Raises `ValueError` if it is farther than `REACH` from the origin.
        """
        x, y, z = place
        _check_reach(hypot(x, y))
        turn = self.bearing
        east = x * cos(turn) + y * sin(turn)
        north = y * cos(turn) - x * sin(turn)
        up = -(east * east + north * north) / (2 * _EQUATOR)
        for _ in range(2):  # down to the level of the origin, which sinks below the plane
            latitude, longitude, height = _geodetic(self._from_plane(east, north, up))
            up += self.altitude - height
        return degrees(latitude), degrees(longitude), self.altitude + z

    def to_metres(self, place: Degrees) -> Metres:
        """Return x, y and z on the map of a latitude and longitude, in degrees, and an altitude.

        Raises `ValueError` if it is farther than `REACH` from the origin.
        """
        latitude, longitude, altitude = place
        there = _earth_centred(radians(latitude), radians(longitude), self.altitude)
        _check_reach(dist(there, self._origin))
        away = [one - other for one, other in zip(there, self._origin, strict=True)]
        to_east, to_north, _ = self._axes
        east = sum(map(_product, to_east, away))
        north = sum(map(_product, to_north, away))
        turn = self.bearing
        x = east * cos(turn) - north * sin(turn)
        y = north * cos(turn) + east * sin(turn)
        return x, y, altitude - self.altitude

    @cached_property
    def _origin(self) -> Metres:
        return _earth_centred(radians(self.latitude), radians(self.longitude), self.altitude)

    @cached_property
    def _axes(self) -> tuple[Metres, Metres, Metres]:
        """Where east, north and up are at the origin, in Earth-centred coordinates."""
        of_lat = radians(self.latitude)
        of_lon = radians(self.longitude)
        return (
            (-sin(of_lon), cos(of_lon), 0.0),
            (-sin(of_lat) * cos(of_lon), -sin(of_lat) * sin(of_lon), cos(of_lat)),
            (cos(of_lat) * cos(of_lon), cos(of_lat) * sin(of_lon), sin(of_lat)),
        )

    def _from_plane(self, east: float, north: float, up: float) -> Metres:
        x, y, z = (
            at + east * to_east + north * to_north + up * to_sky
            for at, to_east, to_north, to_sky in zip(self._origin, *self._axes, strict=True)
        )
        return x, y, z


def _product(one: float, other: float) -> float:
    return one * other


def _check_reach(far: float) -> None:
    if not far <= REACH:  # nor is what is no number
        away = f"{far / 1000:,.0f} km" if isfinite(far) else "out of reach"
        raise ValueError(f"is {away} from the map's origin: a map reaches {REACH / 1000:.0f} km")


def _earth_centred(latitude: float, longitude: float, height: float) -> Metres:
    """Return Earth-centred coordinates of a place above the ellipsoid, in radians and metres."""
    across = _EQUATOR / sqrt(1 - _ECCENTRICITY * sin(latitude) ** 2)
    from_axis = (across + height) * cos(latitude)
    along_axis = (across * (1 - _ECCENTRICITY) + height) * sin(latitude)
    return from_axis * cos(longitude), from_axis * sin(longitude), along_axis


def _geodetic(place: Metres) -> tuple[float, float, float]:
    """Return latitude, longitude and height of Earth-centred coordinates, by Bowring's formula.

    Near the ground one step of it is exact to a tenth of a millimetre; it is taken twice.
    """
    x, y, z = place
    from_axis = hypot(x, y)
    reduced = atan2(z * _EQUATOR, from_axis * _POLE)
    for _ in range(2):
        latitude = atan2(
            z + _ECCENTRICITY / (1 - _ECCENTRICITY) * _POLE * sin(reduced) ** 3,
            from_axis - _ECCENTRICITY * _EQUATOR * cos(reduced) ** 3,
        )
        reduced = atan2(_POLE * sin(latitude), _EQUATOR * cos(latitude))
    ground = _EQUATOR * sqrt(1 - _ECCENTRICITY * sin(latitude) ** 2)
    height = from_axis * cos(latitude) + z * sin(latitude) - ground
    return latitude, atan2(y, x), height
