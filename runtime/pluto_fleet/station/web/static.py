"""The pages and the floor plan: a fixed table of files, which are read once.

No path is ever made of a request.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from gzip import compress
from hashlib import sha256
from pathlib import Path

from ..map.pictures import PICTURES, Logo

FOLDER = Path(__file__).parent.parent / "pages"

_NAME = re.compile(r"[a-z0-9][a-z0-9_-]*\.[a-z0-9]+")
_FOLDER = re.compile(r"[a-z0-9][a-z0-9_-]*")
_KINDS = {
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".mjs": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
    ".webmanifest": "application/manifest+json",
}
_AT_THE_TOP = {"/": "/pages/index.html", "/manifest.webmanifest": "/pages/manifest.webmanifest"}


@dataclass(frozen=True, slots=True, kw_only=True)
class StaticFile:
    """A static file, with its ETag."""

    type: str
    plain: bytes
    packed: bytes | None
    mark: str


@cache
def pages(folder: Path = FOLDER) -> Mapping[str, StaticFile]:
    """Return the files of a folder, and of those in it, by their addresses."""
    table = {}
    for file in sorted(folder.rglob("*")):
        *folders, name = file.relative_to(folder).parts
        kind = _KINDS.get(file.suffix)
        proper = _NAME.fullmatch(name) and all(map(_FOLDER.fullmatch, folders))
        if kind is not None and proper and file.is_file():
            address = "/".join(["/pages", *folders, name])
            table[address] = _held(kind, file.read_bytes(), packs=True)
    return table | {top: table[page] for top, page in _AT_THE_TOP.items() if page in table}


def picture(place: Path | None) -> tuple[Path | None, StaticFile | None]:
    """Return a floor plan with its path; no file if there is none, or it cannot be read any more."""
    kind = None if place is None else PICTURES.get(place.suffix.lower())
    if place is None or kind is None:
        return place, None
    try:
        return place, _held(kind, place.read_bytes(), packs=False)
    except OSError:
        return place, None


def logo_file(logo: Logo) -> StaticFile:
    """Return the logo of a station as it is served."""
    return _held(logo.type, logo.content, packs=False)


def _held(kind: str, content: bytes, *, packs: bool) -> StaticFile:
    return StaticFile(
        type=kind,
        plain=content,
        packed=compress(content, mtime=0) if packs else None,
        mark=f'W/"{sha256(content).hexdigest()[:24]}"',
    )
