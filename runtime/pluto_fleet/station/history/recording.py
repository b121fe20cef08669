"""Writing a recording: what pages were shown of a flight, to be replayed as it was seen.

The file is gzip of JSON lines, which `zcat` prints. Each member of the gzip file begins with a
keyframe, which has every row; the lines after it have what has changed. A reader so needs one
member for any instant, and what was cut off by a crash or a full disk is the end of the last one.
It is never synced: the flight waits for the disk, and must not wait for this.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from .lines import checked, time_of
from .members import GZIP, kept

SUFFIX = ".recording"
"""The end of a recording's name; that of a flight is beside its journal."""

VERSION = 1

KEYFRAME_EVERY = 30.0
"""Seconds, of the time that is recorded at speed 1, after which a keyframe is written."""

LARGEST_MEMBER = 4 * 1024 * 1024
"""Bytes of lines after which a keyframe is written earlier."""

MOVES_EVERY = 0.25
"""Seconds between two lines in which nothing has changed but what always changes in flight."""

MOVING = frozenset({"x", "y", "z", "battery", "seen", "seen_at", "ready_in"})
"""The fields of drones that always change in flight."""

Row = Mapping[str, Any]


class Recording:
    """A recording that is being written, by a station of a flight, or by anything that has rows.

    A rehearsal in virtual time writes one, too: `write` for each instant at which something has
    changed, `tell` for each line of its console, `bring` for each result, and `finish`. In the
    station's folder for rehearsals (`rehearsals_in` of `folder.py`) it is replayed by its name as
    a flight is by that of its journal.

    An existing file is gone on with. Each method may raise `OSError`: then nothing more can be
    written, and what was written stays readable.
    """

    def __init__(
        self,
        path: Path,
        *,
        begun_at: int,
        speed: float = 1.0,
        largest: int | None = None,
    ) -> None:
        """Open it; the instant 0 was `begun_at`, in milliseconds since 1970.

        `speed` is how many recorded seconds pass in one for those who look: what moves is kept
        four times in one of theirs. A file that would become larger than `largest` bytes raises
        an `OSError`.
        """
        self._moves_every, self._keyframe_every = MOVES_EVERY * speed, KEYFRAME_EVERY * speed
        self._largest = largest
        self._state: dict[str, Any] = {}
        self._rows: dict[str, dict[str, Row]] = {}
        """The rows as they were written last, by kind and name."""
        self._pending: list[bytes] = []
        self._key_at = self._line_at = 0.0
        self._member: Any = None
        self._is_whole = True
        """Whether all could be written until now."""
        self._keyed = False
        """Whether this member has its keyframe."""
        self._raw = 0
        """Bytes of lines in this member."""
        size, rest, last = kept(path)
        self._file = path.open("r+b" if size is not None else "xb")
        try:
            self._file.truncate(size or 0)
            self._file.seek(size or 0)
            self.size = size or 0
            """Bytes in the file."""
            if not self.size and not rest:
                self._pending.append(_line({"recording": VERSION, "begun_at": begun_at}))
            self._pending += rest
            self._line_at = _time_of(last)
            self._end_member()
            self.flush()
        except BaseException:
            self._file.close()
            raise

    def write(
        self,
        t: float,
        state: Row,
        missions: Iterable[Row],
        drones: Iterable[Row],
        alerts: Iterable[Row] = (),
    ) -> None:
        """Write what is shown from `t` on, in seconds: the state and all rows, also unchanged ones.

        What has not changed costs nothing, least of all where a row is the same object as before;
        what only moves is left out if it was written just now. Rows must not change afterwards.
        A time before the last one counts as that: what is shown later is replayed later.
        """
        t = max(t, self._line_at)
        rows = {
            "missions": {str(row["name"]): row for row in missions},
            "drones": {str(row["id"]): row for row in drones},
            "alerts": {str(row["id"]): row for row in alerts},
        }
        stands = {name: value for name, value in state.items() if name != "time"}
        due = t - self._key_at >= self._keyframe_every or self._raw > LARGEST_MEMBER
        gone = any(self._rows[kind].keys() - rows[kind].keys() for kind in self._rows)
        if not self._keyed or due or gone:
            self._end_member()
            whole = {kind: [*named.values()] for kind, named in rows.items()}
            self._add({"t": t, "key": True, "state": stands, **whole})
            self._key_at, self._keyed = t, True
        else:
            line, moves = self._changes(stands, rows)
            if not line or (moves and t - self._line_at < self._moves_every):
                return
            self._add({"t": t, **line})
        self._line_at, self._state, self._rows = t, stands, rows

    def tell(self, line: Row, after: int = 0) -> None:
        """Write a line of the console.

        `after` is how many lines of the flight's journal stood before it on the console; without
        a journal all lines are written here, in order.
        """
        self._add({"log": line, "after": after})

    def bring(self, result: Row) -> None:
        """Write a result that no journal has."""
        self._add({"result": result})

    def flush(self) -> None:
        """Give all that was written to the system, so that it outlives this process."""
        if not self._pending:
            return
        if self._member is None:
            self._member = zlib.compressobj(6, zlib.DEFLATED, GZIP)
        self._put(self._compressed() + self._member.flush(zlib.Z_SYNC_FLUSH))

    def finish(self) -> None:
        """End it, and close the file, whatever happens."""
        try:
            self._end_member()
        finally:
            self._file.close()

    def _changes(self, state: Row, rows: Mapping[str, Mapping[str, Row]]) -> tuple[Row, bool]:
        """Return what has changed since the last line, and whether that only moves."""
        found: dict[str, Any] = {}
        moves = True
        if state != self._state:
            found["state"], moves = state, False
        for kind, named in rows.items():
            known = self._rows[kind]
            changes: dict[str, Any] = {}
            for name, row in named.items():
                before = known.get(name)
                if row is before:
                    continue
                change = change_of(before, row)
                if change:
                    changes[name] = change
                    moves &= kind == "drones" and MOVING.issuperset(change)
            if changes:
                found[kind] = changes
        return found, moves

    def _add(self, line: Row) -> None:
        self._pending.append(_line(line))
        self._raw += len(self._pending[-1])

    def _end_member(self) -> None:
        """End a member with all that is to be in it; the next line must be a keyframe."""
        if self._pending and self._member is None:
            self._member = zlib.compressobj(6, zlib.DEFLATED, GZIP)
        if self._member is not None:
            self._put(self._compressed() + self._member.flush(zlib.Z_FINISH))
        self._member, self._keyed, self._raw = None, False, 0

    def _compressed(self) -> bytes:
        text = b"".join(self._pending)
        self._pending.clear()
        packed: bytes = self._member.compress(text)
        return packed

    def _put(self, packed: bytes) -> None:
        whole, self._is_whole = self._is_whole, False
        if not whole:
            return  # what is missing before it would make it unreadable
        if self._largest is not None and self.size + len(packed) > self._largest:
            raise OSError(0, f"it has {self._largest // 2**20} MiB, which is the most")
        self._file.write(packed)
        self._file.flush()
        self.size += len(packed)
        self._is_whole = True


def change_of(before: Row | None, row: Row) -> dict[str, Any]:
    """Return the fields of a row that are others than before; `-` has those that are gone."""
    if before is None:
        return dict(row)
    change = {
        name: value
        for name, value in row.items()
        if name not in before or (before[name] is not value and before[name] != value)
    }
    gone = [name for name in before if name not in row]
    return {**change, "-": gone} if gone else change


def changed(before: Row | None, change: Row) -> dict[str, Any]:
    """Return a row with such a change made."""
    row = {**(before or {}), **change}
    for name in row.pop("-", ()):
        row.pop(name, None)
    return row


def _line(data: Row) -> bytes:
    return json.dumps(data, separators=(",", ":"), default=str).encode("ascii") + b"\n"


def _time_of(lines: Sequence[bytes]) -> float:
    """Return the time of the last of these lines that has one."""
    times = (time_of(checked(line)) for line in reversed(lines))
    return next((t for t in times if t is not None), 0.0)
