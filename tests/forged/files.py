"""Journals and recordings that somebody has written to do harm: nothing in them is as it should be."""

from __future__ import annotations

import gzip
import json
import sqlite3
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from random import Random
from typing import Any

from pluto_fleet.journal.database import row_checksum, snapshot_checksum, tip_checksum

DEEP = "[" * 100_000 + "]" * 100_000
RAW = (
    *("", "null", "[]", "[1]", "{}", "[{}]", "1],[2", DEEP, '[{"event":' * 300, "[NaN]"),
    *('[{"event":1,"t":0}]', '[{"event":"log"}]', '[{"event":"drone.x","t":1,"at":[1,2,3]}]'),
    *('[{"event":"trip.completed","t":1}]', '[{"t":1e999,"event":"stopped","how":"x"}]'),
)
"""Rows that are no rows."""

NASTY: Sequence[Any] = (
    *(None, True, -1, 0, 3, 1.5, -2e9, 1e300, 2**70, 10**200, float("nan"), float("inf")),
    *("", "x", "COMPLETED", "\ud800", "\x1b[2J", "x" * 100_000, "=1+1"),
    *([], {}, [[]], [1, 2], [1, 2, 3], ["a"], {"a": 1}, {"$photo": {}}, {"$number": "x"}),
    [[[[[["deep"]]]]]] * 3,
)


def changed(random: Random, data: Any) -> Any:
    """Return data with one part replaced, left out, or there twice."""
    place = data
    while isinstance(place, (list, dict)) and place:
        keys = list(place) if isinstance(place, dict) else range(len(place))
        key: Any = random.choice(keys)
        if not isinstance(place[key], (list, dict)) or random.random() < 0.25:
            break
        place = place[key]
    else:
        return random.choice(NASTY)
    match random.randrange(6):
        case 0:
            del place[key]
        case 1 if isinstance(place, list):
            place.append(place[key])
        case 2:
            place[key] = place[random.choice(keys)]
        case _:
            place[key] = random.choice(NASTY)
    return data


def forged_rows(random: Random, rows: Sequence[str]) -> list[str]:
    """Return the texts of a journal's rows, some of which are others."""
    found = list(rows)
    for _ in range(random.choice((1, 1, 3))):
        number = random.randrange(len(found))
        match random.randrange(8):
            case 0:
                found[number] = random.choice(RAW)
            case 1:
                found.insert(random.randrange(len(found)), found[number])
            case 2 if number:
                del found[number]
            case _:
                try:
                    data = json.loads(found[number])
                except (ValueError, RecursionError):
                    continue
                found[number] = json.dumps(changed(random, data))
    return found


COLUMNS: Sequence[Any] = (-1, 2**62, 1.5, "x", b"\xff", "9" * 400, b"\0" * 1000)
"""What is no number of a row."""


def write_journal(path: Path, rows: Sequence[str], random: Random | None = None) -> None:
    """Put these rows into a journal that is there, with right checksums; with a chance, wrong columns."""
    with closing(sqlite3.connect(path, isolation_level=None)) as database:
        database.execute("DELETE FROM journal")
        for seq, text in enumerate(rows):
            epoch = 1
            wall = 1_700_000_000_000 + seq
            values: list[Any] = [epoch, wall]
            if random is not None and random.random() < 0.02:
                values[random.randrange(2)] = random.choice(COLUMNS)
            checksum = row_checksum(
                seq, values[0], values[1], text.encode("utf-8", "surrogatepass")
            )
            sent: Any = text.encode("utf-8", "surrogatepass").decode("utf-8", "replace")
            database.execute(
                "INSERT INTO journal VALUES (?, ?, ?, ?, ?)", (seq, *values, sent, checksum)
            )
        last = len(rows) - 1
        tip: tuple[Any, ...] = last, 1
        if random is not None and random.random() < 0.1:
            tip = random.choice(((-3, 1), (2**62, 1), (last, 2**63 - 1), (last, "x"), (last, -1)))
        database.execute("DELETE FROM tip")
        database.execute("INSERT INTO tip VALUES (0, ?, ?, ?)", (*tip, tip_checksum(*tip)))
        database.execute("DELETE FROM snapshot")


def write_snapshot(path: Path, seq: int, text: str, wall: Any = 1_700_000_000_000) -> None:
    """Put a snapshot there, with a right checksum."""
    checksum = snapshot_checksum(seq, 1, wall, text.encode())
    with closing(sqlite3.connect(path, isolation_level=None)) as database:
        row = seq, 1, wall, text, checksum
        database.execute("INSERT OR REPLACE INTO snapshot VALUES (?, ?, ?, ?, ?)", row)


_ENDLESS = (
    "ALTER TABLE journal RENAME TO j2; CREATE VIEW journal AS WITH RECURSIVE n(i) AS (SELECT 1"
    " UNION ALL SELECT i + 1 FROM n) SELECT i AS seq, 1 AS epoch, 1 AS wall, '' AS text, 1 AS checksum"
    " FROM n"
)
TABLES = (
    _ENDLESS,
    "CREATE TRIGGER t AFTER INSERT ON journal BEGIN DELETE FROM journal; END",
    "ALTER TABLE journal RENAME TO j2; CREATE VIEW journal AS SELECT * FROM j2",
    "DROP TABLE tip; CREATE VIEW tip AS SELECT 0 AS id, 1 AS seq, 1 AS epoch, 0 AS checksum",
    "CREATE VIRTUAL TABLE v USING fts5(x)",
    "DROP TABLE snapshot; CREATE TABLE snapshot (seq)",
    "DELETE FROM journal",
    "DELETE FROM tip; DELETE FROM journal",
)
"""What makes other tables of a journal's."""


def forged_lines(random: Random, lines: Sequence[bytes]) -> bytes:
    """Return a recording of these lines, some of which are others."""
    found = [json.loads(line) for line in lines]
    texts: list[str] = []
    for one in found:
        if random.random() < 0.2:
            one = changed(random, one)
        texts.append(json.dumps(one) if random.random() < 0.98 else random.choice(RAW))
    return gzip.compress("\n".join([*texts, ""]).encode(), 1)
