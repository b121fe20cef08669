"""Places in a zone of UTM, in metres east and north, as latitude and longitude of WGS 84.

By the series of Krüger to the fourth power of the third flattening, which are exact to less than a millimetre in a zone.
"""

from __future__ import annotations

from math import (
    asin,
    atan,
    atan2,
    atanh,
    cos,
    cosh,
    degrees,
    hypot,
    sin,
    sinh,
    sqrt,
    tan,
)

_EQUATOR = 6_378_137.0
_FLATTENING = 1 / 298.257223563
_ECCENTRICITY = sqrt(_FLATTENING * (2 - _FLATTENING))
_N = _FLATTENING / (2 - _FLATTENING)
_RADIUS = _EQUATOR / (1 + _N) * (1 + _N**2 / 4 + _N**4 / 64)
_BACK = (
    _N / 2 - 2 * _N**2 / 3 + 37 * _N**3 / 96 - _N**4 / 360,
    _N**2 / 48 + _N**3 / 15 - 437 * _N**4 / 1440,
    17 * _N**3 / 480 - 37 * _N**4 / 840,
    4397 * _N**4 / 161280,
)
_SCALE = 0.9996
_EAST = 500_000.0
_SOUTH = 10_000_000.0
_STEPS = 6


def from_utm(zone: int, east: float, north: float, *, is_south: bool) -> tuple[float, float]:
    """Return latitude and longitude, in degrees, of a place in a zone from 1 to 60, in metres."""
    xi = (north - (_SOUTH if is_south else 0.0)) / (_SCALE * _RADIUS)
    eta = (east - _EAST) / (_SCALE * _RADIUS)
    up = xi
    across = eta
    for number, factor in enumerate(_BACK, 1):
        up -= factor * sin(2 * number * xi) * cosh(2 * number * eta)
        across -= factor * cos(2 * number * xi) * sinh(2 * number * eta)
    conformal = asin(sin(up) / cosh(across))
    longitude = 6 * zone - 183 + degrees(atan2(sinh(across), cos(up)))
    return degrees(_geodetic(tan(conformal))), longitude


def _geodetic(conformal: float) -> float:
    """Return the latitude whose conformal latitude has this tangent, by Newton's steps."""
    e = _ECCENTRICITY
    tau = conformal
    for _ in range(_STEPS):
        sine = tau / hypot(1, tau)
        sigma = sinh(e * atanh(e * sine))
        made = tau * hypot(1, sigma) - sigma * hypot(1, tau)
        slope = (1 - e * e) * hypot(1, made) * hypot(1, tau) / (1 + (1 - e * e) * tau * tau)
        tau += (conformal - made) / slope
    return atan(tau)
