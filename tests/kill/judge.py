"""What must hold of a flight whose processes were killed, at any moment.

What was done is counted in the recorder of the simulated world, which only the world writes.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.journal.standing import Standing
from pluto_fleet.report.sentences import line_of
from pluto_fleet.trials.invariants import Invariants
from pluto_fleet.trials.time_rules import PromisesAreKept
from tests.kill.lookout import looks
from tests.kill.painter import painted

Event = dict[str, Any]

ONCE = ("pick_item", "release_item", "spray")
"""The actions that must not be done twice."""

MADE_OF = ("smoke", "intruder")
"""The events that missions are made of."""

ENDS = ("COMPLETED", "FAILED", "UNCERTAIN")


def events_of(rows: Sequence[str]) -> Iterator[Event]:
    for row in rows:
        yield from json.loads(row)


def phase(standing: Standing) -> str:
    """Say in a word what went on."""
    missions = standing.missions.values()
    if not missions:
        return "setting out"
    if all(record["ended"] for record in missions):
        return "all missions ended"
    flights = [record["flight"] for record in missions if record["flight"] is not None]
    flying = [flight for flight in flights if flight["outcome"] is None]
    if any(one["begun"] for one in flying):
        return "during an action"
    return "in flight" if flying else "between trips"


def lost(before: Sequence[str], after: Sequence[str]) -> Iterator[str]:
    """Yield what was in the journal once, and is not any more."""
    for number, row in enumerate(before):
        if number >= len(after) or after[number] != row:
            yield f"row {number} of the journal is not there any more: {row}"
            return


def unkept(printed: Sequence[str], rows: Sequence[str]) -> Iterator[str]:
    """Yield what a life has told of, and the journal does not know."""
    known = {line for event in events_of(rows) if (line := line_of(event)) is not None}
    for text in printed:
        whole = text.rpartition("\n")[0].split("\n")
        for line in whole:
            if " s  " in line[:12] and line not in known:
                yield f"it was printed, but is not in the journal: {line}"


def done_by_the_world(journal: Path) -> Counter[tuple[str, str]]:
    """Count what was physically done, by the action and the trip's mission, name and round.

    The painter's own action is none of the drones': it is counted where that writes it down.
    """
    file = gateway_folder(journal) / "world.jsonl"
    counts: Counter[tuple[str, str]] = Counter()
    for line in file.read_text().splitlines() if file.exists() else ():
        entry = json.loads(line)
        if entry["action"] in ONCE:
            counts[entry["action"], str(entry["job"]).rpartition("/")[0]] += 1
    for trip in painted(journal.parent):
        counts["spray", f"{trip.partition('-')[0]}/{trip}/0"] += 1
    return counts


def wrong(journal: Path, rows: Sequence[str], standing: Standing) -> Iterator[str]:
    """Yield what is wrong with how it ended, beside the world's own record."""
    promises = Invariants({}, rules=[PromisesAreKept])
    for event in events_of(rows):
        promises.take(event)
    yield from promises.over()
    done = done_by_the_world(journal)
    for (action, trip), times in done.items():
        if times > 1:
            yield f"{action} of {trip} was done {times} times"
    for name, record in standing.missions.items():
        if record["question"] is not None:
            continue  # that is not known: a person decides
        if not record["ended"]:
            yield f"{name} has not ended: {record['status']}"
        elif record["status"] not in ENDS:
            yield f"{name} ended as {record['status']}"
        elif record["status"] == "FAILED" and not record["reason"]:
            yield f"{name} FAILED without a reason"
        for trip in record["done"]:
            key = trip["action"], f"{name}/{trip['name']}/{record['round']}"
            if trip["action"] in ONCE and done[key] != 1:
                yield f"{key[1]} is COMPLETED, and the world has done it {done[key]} times"


def mistaken(taken: Mapping[str, bool], rows: Sequence[str], standing: Standing) -> Iterator[str]:
    """Yield which events were lost, happened twice, or did not come to just one mission.

    `taken` has all that it was told of, by whether it has said that it has taken them over.
    """
    raised = Counter(event["id"] for event in events_of(rows) if event["event"] == "event.raised")
    for id, answered in taken.items():
        if answered and id not in raised:
            yield f"event {id} was taken over, and has not happened"
    for id, times in raised.items():
        if times > 1:
            yield f"event {id} has happened {times} times"
    for id, row in standing.happenings.items():
        if row["event"]["name"] not in MADE_OF:
            continue
        missions = [name for name in standing.missions if name == id or name.startswith(f"{id} ")]
        if row["open"] or row.get("made") != [id] or missions != [id]:
            yield f"of event {id} came {missions}, and it says {row}"


def outlived(folder: Path, rows: Sequence[str]) -> Iterator[str]:
    """Yield the actions along the way that went on while their trips did not fly."""
    flown: dict[str, list[list[float]]] = {}
    for event in events_of(rows):
        if event["event"] == "trip.launched":
            flown.setdefault(event["trip"], []).append([event["t"]])
        elif event["event"] in ("trip.completed", "trip.failed", "trip.interrupted"):
            flown[event["trip"]][-1].append(event["t"])
    for look in looks(folder):
        if not any(begun <= look.time <= end for begun, end in flown[look.trip]):
            yield f"at {look.time} s {look.trip} looked, and has flown {flown[look.trip]}"
