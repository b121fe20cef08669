"""The file that has the map's landmarks: read, and written so that all else in it keeps its bytes."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...files.landmarks import KEYS, NO_LANDMARKS, Landmarks, read_landmarks
from ...files.landmarks_text import with_landmarks
from ...files.reading import PlanTable, parsed, text_of
from ...shared.alone.files import read_map
from ...shared.domain.errors import BadInput
from ...shared.domain.text import printable
from ..whole_file import write_whole

if TYPE_CHECKING:
    from ...shared.domain.airspace import Airspace

_MARK = "\ufeff".encode()
"""What some editors put before the text."""


class MapFile:
    """A fleet file, or one with a `[map]` alone."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._text: str | None = None
        self.landmarks = NO_LANDMARKS
        """Those of the file when it was read last."""

    @property
    def folder(self) -> Path:
        """Where it lies, and pictures beside it."""
        return self.path.parent

    def read(self) -> bool:
        """Read it; return whether its landmarks have changed. Raises `BadInput` if it cannot be read."""
        text = text_of(self.path) if os.path.lexists(self.path) else None
        if text == self._text:
            return False
        if text is None:
            raise BadInput(f"{self._called} is not there any more: put it back first")
        _, found, _ = self._content(text)
        self._text, before, self.landmarks = text, self.landmarks, found
        return found != before

    @property
    def why_not(self) -> str:
        """Why it cannot be written; empty: it can."""
        target = self._target
        may = os.access(target.parent, os.W_OK | os.X_OK)
        if target.exists():
            may = may and os.access(target, os.W_OK)
        return "" if may else f"{self._called} may only be read: nothing is kept that is drawn"

    def write(self, landmarks: Landmarks) -> None:
        """Write other landmarks into it; raise `BadInput` if that cannot be done, and nothing changes then."""
        if self.why_not:
            raise BadInput(self.why_not)
        text = self._text or ""
        airspace, _, rest = self._content(text)
        size = airspace.size
        written = with_landmarks(text, self.landmarks, landmarks, size)
        flown, found, still = self._content(written)
        if (flown, still) != (airspace, rest) or _sorted(found) != _sorted(landmarks):
            raise BadInput(
                f"{self._called} is written so that what is drawn cannot be put into it without changing"
                " more: write [map], and below it [[map.places]] and [[map.zones]]"
            )
        target = self._target
        try:
            mode = stat.S_IMODE(target.stat().st_mode) if target.exists() else 0o644
            begins = target.read_bytes()[: len(_MARK)] if target.exists() else b""
            write_whole(target, (_MARK if begins == _MARK else b"") + written.encode(), mode)
        except OSError as error:
            raise BadInput(f"{self._called} cannot be written: {error.strerror or error}") from None
        self._text, self.landmarks = written, found

    @property
    def _called(self) -> str:
        return printable(str(self.path))

    @property
    def _target(self) -> Path:
        """The file itself, where the path is a link to it."""
        return Path(os.path.realpath(self.path))

    def _content(self, text: str) -> tuple[Airspace, Landmarks, Any]:
        """Return a text's map, its landmarks, and all else in it."""
        document = parsed(self._called, text)
        table = PlanTable(document, document.data).table("map")
        airspace = read_map(table)
        landmarks = read_landmarks(table, airspace)
        document.refuse_if_bad()
        assert airspace is not None  # else there was a problem
        of_map: Any = document.data.get("map", {})
        rest = {key: value for key, value in of_map.items() if key not in KEYS}
        return airspace, landmarks, {**document.data, "map": rest}


def _sorted(landmarks: Landmarks) -> object:
    """Return landmarks to be compared: what is there already keeps its order in a file."""
    return (
        set(landmarks.places),
        set(landmarks.zones),
        landmarks.north,
        landmarks.picture,
    )
