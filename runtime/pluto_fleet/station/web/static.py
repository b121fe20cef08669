"""The pages and the floor plan: a fixed table of files, which are read once.

No path is ever made of a request.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from gzip import compress
from hashlib import sha256
from pathlib import Path

from ...shared.domain.errors import BadInput
from ...shared.domain.text import shown
from .http import Reply, Request

FOLDER = Path(__file__).parent.parent / "pages"

_NAME = re.compile(r"[a-z0-9][a-z0-9_-]*\.[a-z0-9]+")
_FOLDER = re.compile(r"[a-z0-9][a-z0-9_-]*")
_PACKED = (".png", ".woff2")
"""The kinds of files that are compressed by themselves."""
_KINDS = {
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".mjs": "text/javascript; charset=utf-8",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".webmanifest": "application/manifest+json",
    ".woff2": "font/woff2",
}
_AT_THE_TOP = {"/": "/pages/index.html", "/manifest.webmanifest": "/pages/manifest.webmanifest"}
_PICTURES = {
    ".jpeg": "image/jpeg",
    ".jpg": "image/jpeg",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".webp": "image/webp",
}
_LARGEST = 20 * 1024 * 1024


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
            table[address] = _held(kind, file.read_bytes(), packs=file.suffix not in _PACKED)
    return table | {top: table[page] for top, page in _AT_THE_TOP.items() if page in table}


def floor_plan(folder: Path, name: str) -> Path:
    """Return the picture that a fleet file names, if it is valid and beside that file."""
    place = folder / name
    if place.suffix.lower() not in _PICTURES:
        kinds = ", ".join(_PICTURES)
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
    if size is None or size > _LARGEST:
        raise BadInput(f"map.image: {shown(name)} must be a file of at most 20 MB")
    return found


def picture(place: Path) -> StaticFile | None:
    """Return the floor plan; None if it cannot be read any more."""
    kind = _PICTURES.get(place.suffix.lower())
    try:
        return None if kind is None else _held(kind, place.read_bytes(), packs=False)
    except OSError:
        return None


def file_reply(held: StaticFile, request: Request) -> Reply:
    """Answer with a file, or 304 if the browser has it already."""
    headers = (("ETag", held.mark), ("Cache-Control", "no-cache"), ("Vary", "Accept-Encoding"))
    if held.mark in request.headers.get("if-none-match", ""):
        return Reply(status=304, type=held.type, headers=headers)
    if held.packed is not None and "gzip" in request.headers.get("accept-encoding", ""):
        packed = (("Content-Encoding", "gzip"), *headers)
        return Reply(status=200, body=held.packed, type=held.type, headers=packed)
    return Reply(status=200, body=held.plain, type=held.type, headers=headers)


def _held(kind: str, content: bytes, *, packs: bool) -> StaticFile:
    return StaticFile(
        type=kind,
        plain=content,
        packed=compress(content, mtime=0) if packs else None,
        mark=f'W/"{sha256(content).hexdigest()[:24]}"',
    )
