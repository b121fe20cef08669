"""A GeoTIFF as the picture of a map: where it lies by its own tags, and a picture of it that browsers show.

Taken are pictures in degrees of WGS 84, or in one of its UTM zones, as mosaic programs make them. It takes Pillow.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from io import BytesIO
from math import atan2, degrees, dist, hypot
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..extras import has
from ..geodesy import LocalPlane
from ..shared.domain.airspace import Corner
from ..shared.domain.text import number
from .drawings.feature import Unusable
from .landmarks import Picture
from .utm import from_utm

if TYPE_CHECKING:
    from PIL.Image import Image

MOST_PIXELS = 150_000_000
"""Of the file: in memory each takes four bytes."""
MOST_SIDE = 4096
"""Pixels of the longer side of the picture that is made: more are no use on a screen."""
SKEWED = 1.0
"""Metres by which a corner may lie elsewhere than a picture that is only turned has it."""
_QUALITY = 85
_STARTS = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")

_SCALE = 33550
_TIE_POINT = 33922
_MATRIX = 34264
_KEYS = 34735
"""Tags of a GeoTIFF: metres or degrees a pixel, where one lies, both in a matrix, and a list of keys."""
_RASTER = 1025
_DEGREES = 2048
_METRES = 3072
_MIDDLES = 2
"""Keys: whether places are those of the middles of pixels; the codes of reference systems, in degrees and in metres."""
_WGS_84 = 4326
_NORTH = range(32601, 32661)
_SOUTH = range(32701, 32761)

OnEarth = Callable[[float, float], tuple[float, float]]
"""Makes of the two coordinates of a file a latitude and a longitude."""


def is_tiff(file: Path) -> bool:
    """Return whether a file begins as a TIFF does."""
    try:
        with file.open("rb") as opened:
            return opened.read(4) in _STARTS
    except OSError:
        return False  # who reads it says why


def picture_of(file: Path, plane: LocalPlane | None) -> tuple[bytes, Picture]:
    """Return a GeoTIFF as a JPEG, or as a WebP where it is transparent, and where it lies on a map.

    The picture's file is called as the GeoTIFF, and has another ending. Raises `Unusable` with what is wrong.
    """
    if plane is None:
        raise Unusable("lies on the Earth, and the map has no origin: write one below [map]")
    if not has("station"):
        raise Unusable('takes Pillow, of the extra `station`: pip install "pluto-fleet[station]"')
    from PIL import Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter(
                "ignore"
            )  # of its size, which is looked at, and of tags that are cut off
            with Image.open(file, formats=["TIFF"]) as image:
                return _taken(file, image, plane)
    except Image.DecompressionBombError:
        raise Unusable(_TOO_LARGE) from None
    except Unusable:
        raise
    except _DECODING:
        raise Unusable(_UNREADABLE) from None


_DECODING: tuple[type[Exception], ...] = (Exception,)
"""What a damaged or hostile picture makes Pillow raise: that differs by how it is compressed."""
_UNREADABLE = (
    "cannot be read as a TIFF: it is damaged, or compressed as few programs do:"
    " gdal_translate -co COMPRESS=DEFLATE FIELD.tif NEW.tif"
)
_TOO_LARGE = (
    f"has more than {MOST_PIXELS // 1_000_000} million pixels: make it smaller first,"
    " as by gdal_translate -outsize 25% 0 FIELD.tif SMALL.tif"
)


def _taken(file: Path, image: Any, plane: LocalPlane) -> tuple[bytes, Picture]:
    if image.width * image.height > MOST_PIXELS:
        raise Unusable(_TOO_LARGE)
    tags: Mapping[int, Any] = image.tag_v2
    corners = _corners(image.size, tags, plane)
    content, ending = _shown(image)
    return content, _lying(f"{file.stem}{ending}", corners)


def _corners(size: tuple[int, int], tags: Mapping[int, Any], plane: LocalPlane) -> list[Corner]:
    """Return where the corners lie on the map: lower left, lower right, upper right, upper left."""
    keys = _keys(tags.get(_KEYS, ()))
    on_earth = _reference(keys)
    half = 0.5 if keys.get(_RASTER) == _MIDDLES else 0.0
    width, height = size
    found = []
    for column, row in ((0, height), (width, height), (width, 0), (0, 0)):
        latitude, longitude = on_earth(*_place(tags, column - half, row - half))
        if not (abs(latitude) <= 90 and abs(longitude) <= 180):
            raise Unusable("says of itself that it lies at no place on the Earth")
        try:
            x, y, _ = plane.to_metres((latitude, longitude, plane.altitude))
        except ValueError as error:
            raise Unusable(
                f"has a corner at {latitude:.6f}, {longitude:.6f}, which {error}"
            ) from None
        found.append((x, y))
    return found


def _place(tags: Mapping[int, Any], column: float, row: float) -> tuple[float, float]:
    """Return the coordinates of a point of the picture, in the file's reference system."""
    if _MATRIX in tags:
        a, b, _, c, d, e, _, f, *_ = map(float, tags[_MATRIX])
        return a * column + b * row + c, d * column + e * row + f
    if _SCALE not in tags or _TIE_POINT not in tags:
        raise Unusable("is a TIFF that does not say where it lies: a GeoTIFF does")
    right, down = map(float, tags[_SCALE][:2])
    at_column, at_row, _, x, y = map(float, tags[_TIE_POINT][:5])
    return x + (column - at_column) * right, y - (row - at_row) * down


def _keys(listed: Sequence[int]) -> dict[int, int]:
    """Return the keys of a GeoTIFF whose values are numbers in the list itself."""
    entries = (listed[start : start + 4] for start in range(4, len(listed) - 3, 4))
    return {key: value for key, where, _, value in entries if where == 0}


def _reference(keys: Mapping[int, int]) -> OnEarth:
    code = keys.get(_METRES, keys.get(_DEGREES))
    if code == _WGS_84:
        return lambda x, y: (y, x)
    if code is not None and (code in _NORTH or code in _SOUTH):
        is_south = code in _SOUTH
        zone = code % 100
        return lambda x, y: from_utm(zone, x, y, is_south=is_south)
    called = "no known reference system" if code is None else f"EPSG:{code}"
    raise Unusable(
        f"is in {called}, and taken are WGS 84 in degrees (EPSG:4326) and its UTM zones:"
        " gdalwarp -t_srs EPSG:4326 FIELD.tif DEGREES.tif"
    )


def _lying(name: str, corners: Sequence[Corner]) -> Picture:
    """Return where a picture lies with these corners, the lower left first, and then around it."""
    lower, end, last, upper = corners
    wide = (end[0] - lower[0], end[1] - lower[1])
    high = (upper[0] - lower[0], upper[1] - lower[1])
    width = hypot(*wide)
    height = hypot(*high)
    if wide[0] * high[1] <= wide[1] * high[0]:
        raise Unusable("lies on the ground as in a mirror, or covers none")
    straight = (lower[0] - wide[1] / width * height, lower[1] + wide[0] / width * height)
    off = max(dist(upper, straight), dist(last, (straight[0] + wide[0], straight[1] + wide[1])))
    if off > SKEWED:
        raise Unusable(
            f"is no rectangle on the map, by {number(round(off, 1))} m: gdalwarp -t_srs EPSG:4326 makes one of it"
        )
    return Picture(
        file=name,
        at=(round(lower[0], 3) + 0.0, round(lower[1], 3) + 0.0),
        size=(round(width, 3), round(height, 3)),
        turn=round(-degrees(atan2(wide[1], wide[0])), 4) + 0.0,
    )


def _shown(image: Image) -> tuple[bytes, str]:
    """Return a picture that browsers show, and the ending of its name."""
    if image.mode not in ("1", "L", "LA", "P", "PA", "RGB", "RGBA", "CMYK", "YCbCr"):
        raise Unusable("has measurements in its pixels, such as heights, and no colours")
    image.thumbnail((MOST_SIDE, MOST_SIDE))
    is_clear = image.mode in ("LA", "PA", "RGBA") or "transparency" in image.info
    made = BytesIO()
    image.convert("RGBA" if is_clear else "RGB").save(
        made, "WEBP" if is_clear else "JPEG", quality=_QUALITY
    )
    return made.getvalue(), ".webp" if is_clear else ".jpg"
