"""Journals that somebody has written to do harm: nothing in them is as it should be."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from random import Random
from typing import Any

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


def forged_texts(random: Random, rows: Sequence[str]) -> list[str]:
    """Return the texts of a journal, some of which are others."""
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


def write_events(path: Path, texts: Sequence[str], random: Random | None = None) -> None:
    """Put these events into a journal that is there; with a chance, with wrong columns."""
    with closing(sqlite3.connect(path, isolation_level=None)) as database:
        database.execute("DELETE FROM event")
        for seq, text in enumerate(texts):
            columns: list[Any] = [1, 1_700_000_000_000 + seq]
            if random is not None and random.random() < 0.02:
                columns[random.randrange(2)] = random.choice(COLUMNS)
            sent = text.encode("utf-8", "surrogatepass").decode("utf-8", "replace")
            database.execute("INSERT INTO event VALUES (?, ?, ?, ?)", (seq, *columns, sent))


def write_rows(path: Path, random: Random) -> None:
    """Replace some of the rows of a journal by others."""
    with closing(sqlite3.connect(path, isolation_level=None)) as database:
        for table in ("mission", "trip", "drone", "app"):
            key = {"mission": "name", "trip": "number", "drone": "id", "app": "fact"}[table]
            for name, text in database.execute(f"SELECT {key}, text FROM {table}").fetchall():
                if random.random() < 0.3:
                    other = json.dumps(changed(random, json.loads(text)))
                    other = other if random.random() < 0.8 else random.choice(RAW)
                    update = f"UPDATE {table} SET text = ? WHERE {key} = ?"
                    database.execute(update, (other, name))


_ENDLESS = (
    "ALTER TABLE event RENAME TO e2; CREATE VIEW event AS WITH RECURSIVE n(i) AS (SELECT 1"
    " UNION ALL SELECT i + 1 FROM n) SELECT i AS seq, 1 AS epoch, 1 AS wall, '' AS text FROM n"
)
TABLES = (
    _ENDLESS,
    "CREATE TRIGGER t AFTER INSERT ON event BEGIN DELETE FROM event; END",
    "ALTER TABLE event RENAME TO e2; CREATE VIEW event AS SELECT * FROM e2",
    "DROP TABLE app; CREATE VIEW app AS SELECT 'epoch' AS fact, '1' AS text",
    "CREATE VIRTUAL TABLE v USING fts5(x)",
    "DROP TABLE result; CREATE TABLE result (number)",
    "DELETE FROM event",
    "DELETE FROM app; DELETE FROM event",
)
"""What makes other tables of a journal's."""
