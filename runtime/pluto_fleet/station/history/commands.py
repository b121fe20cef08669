"""Who commanded what in a flight: by its journal, and by the station's log of commands."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...process.untrusted import parsed

if TYPE_CHECKING:
    from ..wire import FlightSummary, ReportCommand
    from .reading import Event

LOG = "audit.log"
"""The log, in the station's own folder; the one before it has `.1` after its name."""

PLAN = "/api/plan"
"""What begins so changes the plan, and commands nothing."""

BEFORE = 2_000
"""Milliseconds: its times are of whole seconds, and a Start is a moment older than its journal."""

DONE = 200
"""The status of a command that was carried out."""


def commands_of(
    summary: FlightSummary, commanded: Sequence[tuple[Event, float]], own_folder: Path
) -> list[ReportCommand]:
    """Return the commands of a flight in order.

    `commanded` are the journal's events, each with when it was written; a command that only the
    journal has was given by another program.
    """
    known = {str(event["id"]): (float(event["t"]), round(wall * 1000)) for event, wall in commanded}
    names = {str(event["id"]): str(event.get("command", "")) for event, _ in commanded}
    found: list[ReportCommand] = []
    for at, line in _logged(own_folder):
        given = line.get("given")
        given = dict(given) if isinstance(given, dict) else {}
        id = str(given.pop("id", ""))
        if id not in known and not _is_within(summary, at):
            continue
        time, exactly = known.pop(id, (None, at))
        by = given.pop("by", line.get("by"))
        found.append(
            {
                "time": time,
                "at": exactly,
                "command": str(line["do"]).removeprefix("/api/"),
                "given": given,
                "by": by if isinstance(by, str) else None,
                "client": str(line.get("client", "")) or None,
                "said": str(line.get("said", "")),
            }
        )
    for id, (time, at) in known.items():
        found.append(
            {
                "time": time,
                "at": at,
                "command": names[id],
                "given": {},
                "by": None,
                "client": None,
                "said": "",
            }
        )
    return sorted(found, key=lambda command: command["at"] or 0)


def _is_within(summary: FlightSummary, at: int) -> bool:
    begun_at, ended_at = summary["begun_at"], summary["ended_at"]
    if begun_at is None or at < begun_at - BEFORE:
        return False
    return summary["end"] == "flying" or (ended_at is not None and at <= ended_at)


def _logged(own_folder: Path) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield the commands in the log that were carried out, with their time in milliseconds."""
    for name in (f"{LOG}.1", LOG):
        with suppress(FileNotFoundError), (own_folder / name).open(encoding="utf-8") as file:
            for text in file:
                with suppress(
                    ValueError, LookupError, TypeError, AttributeError
                ):  # it is not whole
                    line = parsed(text)
                    if line["status"] == DONE and not line["do"].startswith(PLAN):
                        at = datetime.fromisoformat(line["time"])
                        yield round(at.timestamp() * 1000), line
