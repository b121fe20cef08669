"""Where and when a photo was taken, as mosaic programs read it: EXIF in a JPEG, whose picture keeps its bytes."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime
from fractions import Fraction
from io import BytesIO
from typing import TYPE_CHECKING, Any

from .pictures import DECODING

if TYPE_CHECKING:
    from ...geodesy import Degrees

_IFD = 0x8769
_GPS = 0x8825
_TAKEN = 0x9003
_OFFSET = 0x9011
_FRACTION = 0x9291
"""When it was taken, in UTC: to the second, by how much it is off UTC, and the rest of the second."""
_ACROSS = 0xA002
_DOWN = 0xA003
_FOCAL = 0xA405
"""Its size in pixels, and the focal length that sees as much on a film 36 mm wide: what mosaic programs begin with."""
_FOCAL_ITSELF = 0x920A
_FILM = 36
_HEADER = b"Exif\0\0"
_START = b"\xff\xd8"
_APP_0 = 0xE0
_APP_1 = 0xE1
_LAST_APP = 0xEF
_LONGEST = 0xFFFF - 2


def with_place(jpeg: bytes, place: Degrees, wall: float, far: float | None = None) -> bytes:
    """Return a photo that says where its camera was, by latitude, longitude and altitude, and when.

    `far`: how many times as far away it was as what it shows is wide, if that is known. One that says so itself stays as it is; so does one that is no JPEG, or where Pillow is not installed.
    """
    try:
        from PIL import Image

        with Image.open(BytesIO(jpeg), formats=["JPEG"]) as image:
            exif: Any = image.getexif()
            known = exif.get_ifd(_GPS)
            inner = exif.get_ifd(_IFD)
            across, down = image.size
    except DECODING:
        return jpeg
    if known:
        return jpeg
    taken = datetime.fromtimestamp(wall, UTC)
    exif[_GPS] = _position(place, taken)
    if _TAKEN not in inner:
        inner |= {_TAKEN: f"{taken:%Y:%m:%d %H:%M:%S}", _OFFSET: "+00:00"}
        inner[_FRACTION] = f"{taken.microsecond // 1000:03}"
    inner = {_ACROSS: across, _DOWN: down, **inner}
    if far is not None and not {_FOCAL, _FOCAL_ITSELF} & inner.keys():
        inner[_FOCAL] = max(1, round(_FILM * far))
    exif[_IFD] = inner
    block = _HEADER + exif.tobytes().removeprefix(_HEADER)
    return jpeg if len(block) > _LONGEST else _with_block(jpeg, block)


def _position(place: Degrees, taken: datetime) -> dict[int, object]:
    """Return the tags of GPS; its altitude is above sea level."""
    latitude, longitude, altitude = place
    seconds = Fraction(taken.second * 1000 + taken.microsecond // 1000, 1000)
    return {
        0: b"\2\3\0\0",  # version 2.3
        1: "N" if latitude >= 0 else "S",
        2: _sexagesimal(latitude),
        3: "E" if longitude >= 0 else "W",
        4: _sexagesimal(longitude),
        5: b"\1" if altitude < 0 else b"\0",
        6: _rational(Fraction(round(abs(altitude) * 1000), 1000)),
        7: tuple(map(_rational, (Fraction(taken.hour), Fraction(taken.minute), seconds))),
        18: "WGS-84",
        29: f"{taken:%Y:%m:%d}",
    }


def _sexagesimal(degrees: float) -> tuple[object, ...]:
    """Return degrees, minutes, and seconds to a hundred-thousandth: 0.3 mm."""
    whole = round(abs(degrees) * 3600 * 100_000)
    minutes, seconds = divmod(whole, 60 * 100_000)
    parts = (Fraction(minutes // 60), Fraction(minutes % 60), Fraction(seconds, 100_000))
    return tuple(map(_rational, parts))


def _rational(number: Fraction) -> object:
    from PIL.TiffImagePlugin import IFDRational

    return IFDRational(number.numerator, number.denominator)


def _with_block(jpeg: bytes, block: bytes) -> bytes:
    """Return a JPEG with this block of EXIF in place of its own, behind what says that it is a JFIF."""
    segments = [one for one in _segments(jpeg) if not _is_exif(one)]
    rest = jpeg[len(_START) + sum(map(len, _segments(jpeg))) :]
    new = bytes((0xFF, _APP_1)) + (len(block) + 2).to_bytes(2) + block
    at = 1 if segments and segments[0][1] == _APP_0 else 0
    return b"".join((_START, *segments[:at], new, *segments[at:], rest))


def _segments(jpeg: bytes) -> Iterator[bytes]:
    """Yield the segments of programs with which a JPEG begins."""
    at = len(_START)
    while at + 4 <= len(jpeg) and jpeg[at] == 0xFF and _APP_0 <= jpeg[at + 1] <= _LAST_APP:
        length = 2 + int.from_bytes(jpeg[at + 2 : at + 4])
        yield jpeg[at : at + length]
        at += length


def _is_exif(segment: bytes) -> bool:
    return segment[1] == _APP_1 and segment[4 : 4 + len(_HEADER)] == _HEADER
