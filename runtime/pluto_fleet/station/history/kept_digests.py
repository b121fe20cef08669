"""The digests of all flights in a folder: each journal is read once, and again when it has grown."""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...journal.lock import holder
from ...journal.place import written
from ...process.untrusted import fits, parsed
from ...process.whole_file import write_whole
from ..wire import FlightSummary
from .airborne import Work
from .digest import Digest, digest_of
from .reading import JournalText, journals_in

if TYPE_CHECKING:
    from ...app import App

Stamp = list[int]
"""When a journal was written last, in nanoseconds since 1970, and its size."""

_Kept = tuple[Stamp, FlightSummary, dict[str, Work]]
"""What the file has of each flight."""

FORMAT = 1
"""The version of the file; digests of another one are made anew."""


class KeptDigests:
    """Digests, also in a file, from which the next station takes them."""

    def __init__(self, app: App, folder: Path, file: Path) -> None:
        self._app, self._folder, self._file = app, folder, file
        self._known: dict[str, tuple[Stamp, Digest]] | None = None
        """By id: when and how large the journal was, and its digest."""
        self._in_file: dict[str, tuple[Stamp, Digest]] = {}

    def all(self) -> list[Digest]:
        """Return the digests of all journals there, the newest first."""
        known = self._read() if self._known is None else self._known
        found: dict[str, tuple[Stamp, Digest]] = {}
        there = journals_in(self._folder)
        for id, path in there.items():
            with suppress(FileNotFoundError):  # it has just been deleted
                found[id] = self._digest(id, path, known.get(id))
        if found != self._in_file:
            self._keep(found)
        self._known = found
        newest_first = sorted(found, key=lambda id: _when(*found[id]), reverse=True)
        return [self._present(found[id][1], there[id]) for id in newest_first]

    def of(self, id: str, path: Path) -> Digest:
        """Return the digest of one journal."""
        known = self._read() if self._known is None else self._known
        _, digest = known[id] = self._digest(id, path, known.get(id))
        self._known = known
        return self._present(digest, path)

    def _digest(
        self, id: str, path: Path, known: tuple[Stamp, Digest] | None
    ) -> tuple[Stamp, Digest]:
        stamp = [written(path), path.stat().st_size]
        if known is not None and known[0] == stamp:
            return known
        return stamp, digest_of(id, JournalText(path), self._app)

    def _present(self, digest: Digest, path: Path) -> Digest:
        """Add what the journal itself does not tell: whether it flies now."""
        summary = digest.summary.copy()
        if summary["end"] != "unknown" and holder(path) is not None:
            summary["end"], summary["ended_at"] = "flying", None
        return Digest(summary=summary, work=digest.work)

    def _read(self) -> dict[str, tuple[Stamp, Digest]]:
        """Read the file; whatever is not as expected in it is made anew."""
        found: dict[str, tuple[Stamp, Digest]] = {}
        with suppress(OSError, ValueError, LookupError, TypeError, AttributeError):
            kept = parsed(self._file.read_text(encoding="utf-8"))
            if kept["format"] == FORMAT and kept["app"] == self._app.name:
                for id, (stamp, summary, work) in kept["flights"].items():
                    if fits(_Kept)([stamp, summary, work]):
                        drones = {drone: Work(**one) for drone, one in work.items()}
                        found[id] = stamp, Digest(summary=summary, work=drones)
        self._in_file = found.copy()
        return found

    def _keep(self, found: dict[str, tuple[Stamp, Digest]]) -> None:
        flights: dict[str, Any] = {
            id: (stamp, digest.summary, {drone: asdict(one) for drone, one in digest.work.items()})
            for id, (stamp, digest) in found.items()
        }
        self._in_file = found.copy()
        text = json.dumps({"format": FORMAT, "app": self._app.name, "flights": flights})
        with suppress(OSError):  # then the next station reads the journals again
            write_whole(self._file, text)


def _when(stamp: Stamp, digest: Digest) -> tuple[int, str]:
    """Return what flights are sorted by: one that cannot be read was written at some time, too."""
    written_at = stamp[0] // 1_000_000
    return digest.summary["begun_at"] or written_at, digest.summary["id"]
