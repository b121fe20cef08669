"""Floor plans: which pictures may be one, and where they are kept."""

from __future__ import annotations

import os
import re
from hashlib import sha256
from pathlib import Path
from xml.etree import ElementTree

from ...shared.domain.errors import BadInput
from ...shared.domain.text import quoted, shown

PICTURES = {
    ".jpeg": "image/jpeg",
    ".jpg": "image/jpeg",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".webp": "image/webp",
}
"""The types of pictures that are shown, by the ends of their names."""

LARGEST = 20 * 1024 * 1024
"""The largest picture in bytes."""

_SVG = "{http://www.w3.org/2000/svg}svg"
_DECLARES = re.compile(rb"<!ENTITY", re.IGNORECASE)
_LONGEST_STEM = 40


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
