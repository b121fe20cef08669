"""Pictures that are shown: floor plans, where they are kept, and the logo in the head of all pages."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from xml.etree import ElementTree

from ...shared.domain.errors import BadInput
from ...shared.domain.text import printable, quoted, shown

PICTURES = {
    ".jpeg": "image/jpeg",
    ".jpg": "image/jpeg",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".webp": "image/webp",
}
"""The types of pictures that are shown, by the ends of their names."""

LARGEST = 20 * 1024 * 1024

_SVG = "{http://www.w3.org/2000/svg}svg"
_DECLARES = re.compile(rb"<!ENTITY", re.IGNORECASE)
_LONGEST_STEM = 40
_TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")


def floor_plan(folder: Path, name: str) -> Path:
    """Return the picture that a fleet file names, if it is valid and beside that file."""
    place = folder / name
    if place.suffix.lower() not in PICTURES:
        kinds = ", ".join(PICTURES)
        raise BadInput(f"map.image: {shown(name)} is no picture that can be shown: {kinds}")
    inside = not os.path.isabs(name) and ".." not in Path(name).parts
    try:
        found = place.resolve(strict=True)
        inside = inside and found.is_relative_to(folder.resolve(strict=True))
        size = found.stat().st_size if found.is_file() else None
    except (OSError, ValueError):  # ValueError: a NUL in the name
        raise BadInput(f"map.image: {shown(name)} cannot be read") from None
    if not inside:
        raise BadInput(f"map.image: {shown(name)} must lie in the folder of the fleet file")
    if size is None or size > LARGEST:
        raise BadInput(f"map.image: {shown(name)} must be a file of at most 20 MB")
    return found


def ending_of(content: bytes) -> str:
    """Return the end of a picture's name by what it really is; raise `BadInput` if it is none."""
    if content.startswith(b"\x89PNG\r\n\x1a\n"):
        return ".png"
    if content.startswith(b"\xff\xd8\xff"):
        return ".jpg"
    if content.startswith(b"RIFF") and content[8:12] == b"WEBP":
        return ".webp"
    if content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        _check_drawing(content)
        return ".svg"
    if content.startswith(_TIFF):
        raise BadInput(
            "browsers show no TIFF: the command `pluto-fleet map FLEET.toml FIELD.tif` makes a picture of a"
            " GeoTIFF, and puts it where it lies on a map on the Earth"
        )
    raise BadInput("this is no picture that can be shown: those are PNG, JPEG, WebP and SVG")


def _check_drawing(content: bytes) -> None:
    """Refuse what is no plain SVG: its scripts never run, as it is served so that none may."""
    if _DECLARES.search(content):
        raise BadInput("this drawing declares entities: save it as plain SVG")
    try:
        root = ElementTree.fromstring(content)
    except (ElementTree.ParseError, ValueError) as error:
        raise BadInput(f"this is no valid SVG: {error}") from None
    if root.tag != _SVG:
        raise BadInput(f"this is no SVG: it begins with {quoted(root.tag)}")


def safe_name(given: str, content: bytes) -> str:
    """Return under which name a picture is kept: one of its own, so that it replaces no other."""
    stem = re.sub(r"[^a-z0-9]+", "-", Path(given).stem.lower())[:_LONGEST_STEM].strip("-")
    return f"{stem or 'floor-plan'}-{sha256(content).hexdigest()[:12]}{ending_of(content)}"


LONGEST_TITLE = 60
LARGEST_LOGO = 200_000
"""Bytes."""


@dataclass(frozen=True, slots=True)
class Logo:
    """A picture in the head of all pages."""

    type: str
    content: bytes

    @property
    def address(self) -> str:
        """Its address; another picture has another."""
        return f"/logo?v={sha256(self.content).hexdigest()[:12]}"


def title_of(text: str) -> str:
    """Return a title that is given; raise `BadInput` if it is none that a line can show."""
    title = text.strip()
    if not 0 < len(title) <= LONGEST_TITLE or printable(title) != title:
        raise BadInput(
            f"--title {quoted(text)}: a title is one line of 1 to {LONGEST_TITLE} characters"
        )
    return title


def logo_of(file: Path) -> Logo:
    """Read a logo; raise `BadInput` if it is no picture, or too large."""
    try:
        with file.open("rb") as opened:
            content = opened.read(LARGEST_LOGO + 1)
    except OSError as error:
        raise BadInput(f"--logo {file}: it cannot be read: {error.strerror}") from None
    if len(content) > LARGEST_LOGO:
        raise BadInput(f"--logo {file}: a logo has at most {LARGEST_LOGO // 1000} kB")
    try:
        return Logo(PICTURES[ending_of(content)], content)
    except BadInput as error:
        raise BadInput(f"--logo {file}: {error}") from None
