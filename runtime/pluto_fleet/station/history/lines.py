"""The lines of a recording, which anyone may have written: what is not as pages are shown it is left out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ...process.untrusted import LATEST, Test, fields_of, fits, parsed
from ..wire import Alert, DroneRow, LogLine, MissionRow, Result, State
from .members import Member

Line = dict[str, Any]

NAMED_BY = {"missions": "name", "drones": "id", "alerts": "id"}
"""The kinds of rows, and the field by which one is known."""

LATEST_AT = 10**13
"""The latest plausible instant, in milliseconds since 1970."""

_ROWS = {"missions": MissionRow, "drones": DroneRow, "alerts": Alert}
_GONE = {"-": fits(list[str])}
_SAID = {"time": 0.0, "text": "", "kind": "info"}
"""What a line of the console says that does not say it."""


def lines_of(member: Member) -> Iterator[Line | None]:
    """Yield its lines; None stands for one that is left out. Of a torn one it is the end."""
    for text in member.lines:
        line = checked(text)
        if line is None and member.torn:
            return
        yield line


def time_of(line: Line | None) -> float | None:
    """Return the time of a line that has one."""
    return float(line["t"]) if line is not None and "t" in line else None


def checked(text: bytes) -> Line | None:
    """Return a line; None: it says nothing that pages can be shown."""
    try:
        line: Any = parsed(text)
    except ValueError:
        return None
    match line:
        case {"t": float() | int() as t}:
            return line if 0 <= t <= LATEST and _is_shown(line) else None
        case {"log": dict(said), "after": int(after)}:
            return {"log": {**_SAID, **said}, "after": after} if _suits(said, LogLine) else None
        case {"result": result}:
            return line if fits(Result)(result) else None
        case {"recording": int(), "begun_at": int(begun_at)}:
            return line if 0 <= begun_at <= LATEST_AT else None
    return None


def _is_shown(line: Mapping[str, Any]) -> bool:
    """Whether it says what is shown, and in the right places."""
    if not _suits(line.get("state", {}), State):
        return False
    for kind, by in NAMED_BY.items():
        if "key" in line:
            rows = line.get(kind, [])
            named = isinstance(rows, list) and all(
                isinstance(row, dict) and by in row for row in rows
            )
        else:
            changes = line.get(kind, {})
            named = isinstance(changes, dict)
            rows = changes.values() if named else ()
        if not named or not all(_suits(row, _ROWS[kind], _GONE) for row in rows):
            return False
    return True


def _suits(row: object, hint: Any, also: Mapping[str, Test] | None = None) -> bool:
    """Whether all that is said of a row is of its type; an older station may have said less."""
    tests = {**fields_of(hint), **(also or {})}
    return isinstance(row, dict) and all(
        tests[name](value) for name, value in row.items() if name in tests
    )
