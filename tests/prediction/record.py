"""What was promised of a plan and what came of its flights, kept as JSON lines."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True, kw_only=True)
class Promise:
    """What simulations say before a plan is flown; seconds, and shares of a battery."""

    plan: str
    drones: int
    p5: float
    median: float
    """Of the makespan."""
    p95: float
    battery: float
    """The median of the lowest level at a landing."""
    flights: float
    exact: str
    """What the simulation without spread comes to, in one line."""
    dry_run: str
    """The same of `fly --dry-run`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flown:
    """What came of one flight."""

    plan: str
    code: int
    makespan: float
    """Seconds from the beginning of the missions until the last one ended."""
    began: float
    """Seconds before that: drones are connected, and checked."""
    battery: float
    flights: int
    failed: int
    load: float
    """The load of the machine at the end."""


Line = Promise | Flown


def keep(file: Path, line: Line) -> None:
    """Append a line; a campaign that is interrupted keeps what it has."""
    with file.open("a", encoding="utf-8") as kept:
        kept.write(json.dumps({type(line).__name__: asdict(line)}) + "\n")


def kept(file: Path) -> list[Line]:
    """Return all lines of a file; none if there is no such file."""
    if not file.exists():
        return []
    kinds: dict[str, type[Line]] = {"Promise": Promise, "Flown": Flown}
    lines = map(json.loads, file.read_text(encoding="utf-8").splitlines())
    return [kinds[kind](**data) for line in lines for kind, data in line.items()]


def promised(lines: Iterable[Line]) -> dict[str, Promise]:
    """Return the promises by the plans' names; of two of one plan the later."""
    return {line.plan: line for line in lines if isinstance(line, Promise)}


def flown(lines: Iterable[Line]) -> dict[str, list[Flown]]:
    """Return the flights by the plans' names."""
    found: dict[str, list[Flown]] = {}
    for line in lines:
        if isinstance(line, Flown):
            found.setdefault(line.plan, []).append(line)
    return found
