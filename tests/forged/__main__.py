"""Gives everything that reads journals files that were written to do harm.

    python -m tests.forged --files 2000

Each must be read as far as it can be, or refused in a sentence. `--only N` makes that file again.
"""

from __future__ import annotations

import json
import sqlite3
import sys
from collections.abc import Sequence
from contextlib import closing, suppress
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from pluto_fleet.journal.facts import row_of
from pluto_fleet.journal.standing import Row, Standing
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.time.told import Stuck
from tests.forged.files import (
    TABLES,
    changed,
    forged_texts,
    write_events,
    write_rows,
)
from tests.forged.readers import FLIGHT, faults_of
from tests.kit import apps
from tests.kit.campaign import Campaign
from tests.kit.living import Living, enterable
from tests.library.station.history.test_past import ROWS, kept


def main() -> int:
    """Try the files."""
    campaign = Campaign("tests.forged", __doc__)
    campaign.draws("files", 1000)
    campaign.parse()
    for number, faults in campaign.each(one, campaign.numbers):
        if faults:
            campaign.found(f"file {number}", *faults)
    return campaign.over()


def one(number: int) -> list[str]:
    """Make a file, have it read, and return what must not be."""
    random = Random(number)
    try_it = (_journal, _journal, _rows, _journal, _life, _tables)[number % 6]
    with TemporaryDirectory() as folder:
        return list(try_it(random, Path(folder)))


def _journal(random: Random, folder: Path) -> list[str]:
    write_events(kept(folder, FLIGHT), forged_texts(random, _texts()), random)
    return list(faults_of(folder))


def _rows(random: Random, folder: Path) -> list[str]:
    """Rows of missions, trips and drones, with parts that are others."""
    write_rows(kept(folder, FLIGHT), random)
    return list(faults_of(folder, only=("resume", "flights", "report")))


def _tables(random: Random, folder: Path) -> list[str]:
    journal = kept(folder, FLIGHT)
    with closing(sqlite3.connect(journal)) as database:
        database.executescript(random.choice(TABLES))
    return list(faults_of(folder))


def _life(random: Random, folder: Path) -> list[str]:
    """An app goes on from rows that are others."""
    missions = apps.mission("a", apps.trip("1", 3), apps.trip("2", 4)), apps.mission(
        "b", apps.trip("1", 3, action="pick_item"), apps.trip("2", 5, action="release_item")
    )
    living = Living(enterable(), *missions)
    living.at(random.uniform(1.0, 30.0), lambda: _go_on(random, living))
    with suppress(BadInput, Stuck):
        living.run(5_000.0)
    return []


def _go_on(random: Random, living: Living) -> None:
    """Kill the brain, and begin another one, unless its journal is refused."""
    living.die()
    standing = living.memory.standing()
    rows: list[Row] = []
    for table, key, row in living.memory.rows():
        other = changed(random, dict(row)) if random.random() < 0.2 else row
        with suppress(ValueError):
            rows.append((table, key, row_of(table, key, json.dumps(other))))
    known = Standing(rows, standing.time)
    drones = {drone.id for drone in living.fleet.drones}
    if known.needed - drones:
        living.done.set(0.0)
    else:
        living.memory.replace(rows)
        living.live_on()


@cache
def _texts() -> Sequence[str]:
    (_, header), *rows = map(json.loads, ROWS.read_text("utf-8").splitlines())
    return [json.dumps([header]), *(json.dumps(events) for _, *events in rows)]


if __name__ == "__main__":
    sys.exit(main())
