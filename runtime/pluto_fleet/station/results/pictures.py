"""The pictures that drones have taken: found where a navigation may leave them, and small ones of them.

A picture is asked for by the number of a result, never by a path. Its file is what the navigation
said in that result (`Photo.file`), within the folder that it was given for files
(`DroneSetup.folder`); anything else is refused, and so is what leads out of it.
"""

from __future__ import annotations

import io
import os
import stat
from contextlib import suppress
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Protocol

from ...drones.team import FILES
from ...journal.place import gateway_folder
from ...process.whole_file import write_whole
from ...shared.domain.errors import BadInput
from ...shared.domain.text import quoted

if TYPE_CHECKING:
    from collections.abc import Mapping

LARGEST = 50 * 1024 * 1024
"""Bytes of a picture."""

MOST_PIXELS = 80_000_000
"""Pixels of a picture of which a small one is made: more would take too much memory."""

SMALL = (480, 480)
"""The most pixels of a small picture, across and down."""

SMALL_ONES_KEPT = 5_000
"""The small pictures that are kept; the oldest go first."""

_TYPES = {
    ".jpeg": ("image/jpeg", b"\xff\xd8\xff"),
    ".jpg": ("image/jpeg", b"\xff\xd8\xff"),
    ".png": ("image/png", b"\x89PNG\r\n\x1a\n"),
    ".webp": ("image/webp", b"RIFF"),
}
"""By ending: the media type, and how such a file begins."""

DECODING: tuple[type[Exception], ...] = (Exception,)
"""What a damaged or hostile picture makes its decoder raise: that differs by format."""

_FORMATS = ("JPEG", "PNG", "WEBP")


class Taken(Protocol):
    """A flight whose pictures are asked for."""

    @property
    def flight(self) -> str:
        """Its id."""

    @property
    def journal(self) -> Path:
        """Its journal."""

    @property
    def pictures(self) -> Mapping[int, str]:
        """The files of photos, as their cameras named them, by the numbers of their results."""


def picture(flight: Taken, number: int) -> tuple[bytes, str]:
    """Return the picture of a result as it was taken, and its media type.

    Raises `BadInput` with a sentence: there is none, it is gone, or it is no picture.
    """
    file = flight.pictures.get(number)
    if file is None:
        raise BadInput(f"result {number} has no picture")
    kind, begins = _TYPES.get(PurePath(file).suffix.lower(), ("", b""))
    if not kind:
        known = ", ".join(_TYPES)
        raise BadInput(f"result {number}: {quoted(file)} is no picture that can be shown: {known}")
    content = _content(flight, number, file)
    if not content.startswith(begins):
        raise BadInput(f"result {number}: {quoted(file)} is not the picture that its name says")
    return content, kind


def _content(flight: Taken, number: int, file: str) -> bytes:
    """Read a picture's file, unless it is anywhere else than it may be."""
    folder = gateway_folder(flight.journal) / FILES
    try:
        found = (folder / file).resolve(strict=True)
        inside = found.is_relative_to(folder.resolve(strict=True))
        if not inside:
            raise BadInput(
                f"result {number}: {quoted(file)} does not lie in {folder}, the folder that its"
                " navigation was given for files"
            )
        # All links are resolved: one that was put there since is not followed.
        descriptor = os.open(found, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except (OSError, ValueError, RuntimeError):  # a NUL in the name, a ring of links
        raise BadInput(
            f"result {number}: its picture {quoted(file)} is not there any more"
        ) from None
    about = os.fstat(descriptor)
    if not stat.S_ISREG(about.st_mode) or about.st_size > LARGEST:
        os.close(descriptor)
        most = LARGEST // 1024 // 1024
        raise BadInput(f"result {number}: {quoted(file)} must be a file of at most {most} MB")
    with open(descriptor, "rb") as opened:
        return opened.read(LARGEST)


def shown(flight: Taken, number: int, cache: Path | None) -> tuple[bytes, str]:
    """Return the picture of a result and its media type: a small one if there is a cache for it."""
    if cache is None:
        return picture(flight, number)
    return small(flight, number, cache), "image/jpeg"


def small(flight: Taken, number: int, cache: Path) -> bytes:
    """Return a small JPEG of a picture; it is made once and kept in `cache`, a folder of the station's.

    Raises `BadInput` as `picture` does, and for what cannot be read as a picture.
    """
    content, _ = picture(flight, number)
    kept = cache / f"{flight.flight}-{number}-{len(content)}.jpg"
    with suppress(OSError):
        return kept.read_bytes()
    made = _smaller(content, number)
    cache.mkdir(mode=0o700, parents=True, exist_ok=True)
    write_whole(kept, made)
    _forget_the_oldest(cache)
    return made


def _smaller(content: bytes, number: int) -> bytes:
    try:  # of an extra, without which a station is imported, too
        from PIL import Image, ImageOps
    except ImportError:
        raise BadInput(
            "small pictures need Pillow, of the extra `station`: pip install 'pluto-fleet[station]'"
        ) from None
    try:
        with Image.open(io.BytesIO(content), formats=_FORMATS) as image:
            if image.width * image.height > MOST_PIXELS:  # before a pixel of it is read
                raise BadInput(
                    f"result {number}: its picture has {image.width} × {image.height} pixels, too"
                    " many for a small one: look at it as it was taken"
                )
            image.draft("RGB", SMALL)
            upright = ImageOps.exif_transpose(image)
            upright.thumbnail(SMALL)
            made = io.BytesIO()
            upright.convert("RGB").save(made, "JPEG", quality=80)
            return made.getvalue()
    except BadInput:
        raise
    except DECODING:
        raise BadInput(f"result {number}: its picture is damaged, or not whole") from None


def _forget_the_oldest(cache: Path) -> None:
    found = sorted(cache.glob("*.jpg"), key=lambda path: path.stat().st_mtime_ns)
    for path in found[: max(0, len(found) - SMALL_ONES_KEPT)]:
        path.unlink(missing_ok=True)
