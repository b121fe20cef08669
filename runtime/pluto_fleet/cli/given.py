"""What a command takes out of a plan file: a mission's trips, a drone. What is wrong with it the app tells."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from datetime import time
from pathlib import Path

from ..files.reading import listed, read
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted


def trips_in(file: Path, mission: str) -> object:
    """Return the trips of a mission of a missions file, as they are written there."""
    found = _table(file, "mission", "name", mission)
    for key in ("area", "each"):
        if key in found:
            raise BadInput(
                f"{file}: mission {quoted(mission)} has {key}: write plain trips"
                " (check --write makes them)"
            )
    return found.get("trip", [])


def drone_in(file: Path, id: str) -> Mapping[str, object]:
    """Return a drone of a fleet file, as it is written there."""
    return {key: one for key, one in _table(file, "drone", "id", id).items() if key != "id"}


def _table(file: Path, what: str, key: str, name: str) -> Mapping[str, object]:
    """Return the table with this name, as a command carries it; raise `BadInput` if there is none."""
    tables = list(_tables(read(file).data.get(what)))
    for table in tables:
        if table.get(key) == name:
            carried: Mapping[str, object] = json.loads(json.dumps(table, default=_written))
            return carried
    names = listed(quoted(str(one[key])) for one in tables if key in one)
    raise BadInput(f"{file}: there is no {what} {quoted(name)}; there are: {names}")


def _tables(given: object) -> Iterator[Mapping[str, object]]:
    for one in given if isinstance(given, list) else ():
        if isinstance(one, dict):
            yield one


def _written(value: object) -> str:
    """Write TOML's times and dates as the texts that may stand for them in a file."""
    return f"{value:%H:%M:%S}" if isinstance(value, time) else str(value)
