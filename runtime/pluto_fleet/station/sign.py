"""Whose station it is, for people to see: a title and a logo, in the head of all pages and in the tab."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from ..shared.domain.errors import BadInput
from ..shared.domain.text import printable, quoted
from .map.pictures import PICTURES, ending_of

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
