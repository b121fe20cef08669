"""Journals that are written by hand for tests: events, and the rows that follow from them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from pluto_fleet.journal.standing import Row
from pluto_fleet.journal.store import Entry
from tests.kit.told import Told

NO_MISSION: Mapping[str, Any] = {
    "index": 0,
    "fields": {},
    "status": "UNEXECUTED",
    "reason": "",
    "round": 0,
    "attempts": 0,
    "at": None,
    "delay": None,
    "waited": [],
    "first_start": None,
    "last_action_end": None,
    "flight": None,
    "carrier": None,
    "carries": None,
    "judged": 0,
    "interrupted": False,
    "ended": False,
    "paused": None,
    "question": None,
    "held": None,
    "answer": None,
    "accepted": None,
    "promises": {},
    "late": False,
    "replanned": False,
    "changed": False,
}
"""The row of a mission that has not begun."""


def entry(events: Sequence[Mapping[str, Any]], told: Told) -> Entry:
    """Return an entry of these events; `told` has taken those before."""
    rows: list[Row] = []
    for event in events:
        told.take(event)
        if event["event"] == "stopped":
            rows.append(("app", ("stopped",), {"is": event["t"]}))
    for name, record in told.missions.items():
        known = {fact: record[fact] for fact in NO_MISSION if fact in record}
        rows.append(("mission", (name,), {**NO_MISSION, **known, "flight": None}))
        lists: dict[str, dict[str, object]] = {
            "done": {"status": "COMPLETED"},
            "gone": {"round": 0},
            "todo": {},
        }
        trips = [(trip, facts) for which, facts in lists.items() for trip in record[which]]
        for number, (trip, facts) in enumerate(trips, 1):
            rows.append(
                ("trip", (name, number), {**trip, **facts, "number": number, "rank": number})
            )
    return Entry(json.dumps(list(events)), rows)
