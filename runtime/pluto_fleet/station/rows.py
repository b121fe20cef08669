"""The rows of missions and drones for pages, the blocks at which a mission waits, and sentences with a key."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..flight.control import PRIORITY
from ..flight.mission_status import ANSWERS, aside
from ..flight.reconcile import trip_of
from ..shared.domain.status import Status, TripStatus
from ..shared.domain.text import cut_off

if TYPE_CHECKING:
    from ..app import App
    from ..flight.tracked import Tracked
    from ..gateway.sightings import Sighting
    from ..journal.standing import Record
    from .wire import (
        DroneRow,
        MissionRow,
        Question,
        SaidKey,
        Scalar,
        TrackRow,
        TripRow,
        Words,
    )


def words(key: SaidKey, text: str, **facts: Scalar | list[str]) -> Words:
    """Return a sentence by the key of its translations, its facts, and the sentence in English."""
    return {"key": key, "facts": facts, "text": text}


END = "end"
"""The pseudo-block of missions that have ended."""

ENDED = (Status.COMPLETED, Status.FAILED, Status.CANCELLED)


def blocks_of(where: Mapping[str, Any]) -> list[str]:
    """Return the names of the blocks at which a mission waits."""
    return where["block"].split(", ") if where["block"] else []


LONGEST_REASON = 200
"""Characters of the reason why a drone may not fly; the full text is on the console."""


def row_in_flight(
    name: str,
    records: Mapping[str, Record],
    where: Mapping[str, Any],
    now: float,
    app: App,
    why: Callable[[str, Sequence[Record]], Words | None],
) -> MissionRow:
    """Return the row of one of the missions of a running app, of which its brain says `where` they are.

    `why` returns why no drone flies its trip yet.
    """
    record = records[name]
    at = where.get(name)
    if at is None or not at["lives"] or aside(record) is not None:
        return recorded_row(name, record, lives=True)
    priority = next((one.default for one in app.fields if one.name == PRIORITY), None)
    after = record["promises"].get("after", ())
    first = [one for one in after if not records[one]["ended"]]
    return living_row(name, record, at, app.resumes, priority, now, why, first)


def living_row(
    name: str,
    record: Record,
    where: Mapping[str, Any],
    resumes: Sequence[str],
    priority: object,
    now: float,
    fleet: Callable[[str, Sequence[Record]], Words | None],
    first: Sequence[str],
) -> MissionRow:
    """Return the row of a mission that is `where` its brain says.

    `first` are the missions after which it comes and that have not ended. `resumes` are the blocks that allocate drones, `priority` is that of a trip whose record has none;
    `fleet` returns why no drone flies its trip yet.
    """
    status = Status(record["status"])
    todo = record["todo"]
    at = blocks_of(where)
    moments = {name: where.get(name, known) for name, known in record["promises"].items()}
    opens = None if at or status is not Status.UNEXECUTED else moments.get("opens")
    until = where["until"] or opens
    until = until if (until or 0.0) > now else None
    wait = None
    if where["flies"]:
        pass
    elif first and not at:
        wait = words("wait.after", f"comes after {', '.join(first)}", after=[*first])
    elif until is not None:
        wait = words("wait.time", "waits until its time has come")
    elif not where["allocated"] and at and at[0] in resumes:
        wait = fleet(name, todo) or words("wait.drone", "waits for a drone")
    elif at and status in ENDED:
        wait = words("wait.verdict", f"waits for what {at[0]} says", block=at[0])
    trips = [_trip(trip, "COMPLETED", priority) for trip in record["done"]]
    trips += [_trip(trip, "WAITING", priority) for trip in todo]
    # once its trips are done, a block has yet to decide
    stands = Status.STANDBY if status in ENDED else status
    row = _row(name, record, stands, str(record["reason"]), trips, at, wait)
    row["drone"] = where["drone"]
    row["until"] = until
    row["due"] = moments.get("deadline")
    return row


def recorded_row(name: str, record: Record, *, lives: bool = False) -> MissionRow:
    """Return the row of a mission from its journal's record; `lives`: its app is running."""
    status, reason = aside(record) or (Status(record["status"]), str(record["reason"]))
    if status is Status.RUNNING or (status in ENDED and not record["ended"]):
        status = Status.STANDBY  # it flew, and does so no longer; or its outcome is open
    at = [END] if record["ended"] else [record["at"]] if record["at"] else []
    trips = [_recorded_trip(trip, "COMPLETED") for trip in record["done"]]
    trips += [_recorded_trip(trip, "WAITING") for trip in record["todo"]]
    row = _row(name, record, status, reason, trips, at, _WAITS.get(status) if lives else None)
    if lives:
        row["drone"], row["question"] = record["carrier"], _question(status, reason, record)
    return row


def _row(
    name: str,
    record: Record,
    status: Status,
    reason: str,
    trips: list[TripRow],
    at: list[str],
    wait: Words | None,
) -> MissionRow:
    done, todo = len(record["done"]), record["todo"]
    return {
        "name": name,
        "index": record["index"],
        "status": status.value,
        "reason": reason,
        "trips": trips,
        "current": done if todo else None,
        "done": done,
        "total": len(trips),
        "drone": None,
        "at": at,
        "wait": wait,
        "until": None,
        "attempt": todo[0].get("attempt", 1) if todo else 1,
        "attempts": record["attempts"],
        "round": record["round"],
        "question": None,
        "due": record["promises"].get("deadline"),
        "late": record["late"],
        "fields": {key: one for key, one in record["fields"].items() if one is not None},
    }


def drone_row(
    id: str,
    drone: Mapping[str, Any],
    *,
    status: str = "",
    why: str = "",
    mission: str | None = None,
    seen: float | None = None,
    ready_in: float | None = None,
) -> DroneRow:
    """Return the row of a drone as it stands, rounded to centimetres and thousandths.

    `why`: why it may not fly; `status` replaces its own status if that would mislead; `seen`: when it was
    heard last, if not now; `ready_in`: the seconds until it is charged, if it is not.
    """
    x, y, z = (None,) * 3 if drone["at"] is None else (round(one, 2) for one in drone["at"])
    battery = drone["battery"]
    row: DroneRow = {
        "id": id,
        "status": status or drone["status"],
        "x": x,
        "y": y,
        "z": z,
        "seen_at": None if seen is None else round(seen) * 1000,
        "battery": None if battery is None else round(battery, 3),
        "mission": mission,
        "trips": drone["trips"],
        "retired": drone["retired"],
        "why": cut_off(why, LONGEST_REASON),
    }
    if ready_in is not None:
        row["ready_in"] = round(ready_in)
    return row


def track_row(id: str, one: Tracked) -> TrackRow:
    """Return the row of what is tracked."""
    x, y, z = one.at
    return {
        "id": id,
        "kind": one.kind,
        "x": x,
        "y": y,
        "z": z,
        "seen": one.seen,
        "trail": [[where[0], where[1]] for _, where in one.way],
    }


def drone_at(
    id: str, status: str, seen: Sighting | None, trips: int, retired: bool, why: str
) -> DroneRow:
    """Return the row of a drone without a flight; `seen` is its last known state."""
    drone = {"status": status, "trips": trips, "retired": retired}
    if seen is None:
        return drone_row(id, {**drone, "at": None, "battery": None}, why=why)
    battery = seen.battery if seen.when else None
    return drone_row(id, {**drone, "at": seen.at, "battery": battery}, why=why, seen=seen.when)


def _trip(data: Record, status: str, usual: object = None) -> TripRow:
    x, y, _ = data["target"]
    fields = data.get("fields", {})
    row: TripRow = {
        "name": data["name"],
        "status": data.get("status", status),
        "x": round(x, 3),
        "y": round(y, 3),
        "priority": fields.get(PRIORITY, usual),
        "action": data["action"],
    }
    if isinstance(track := fields.get("track"), str):
        row["track"] = track
    return row


def _recorded_trip(data: Record, status: str) -> TripRow:
    """Return a trip as far as its journal knows it: whether it still flies must be asked first."""
    flew = data.get("status") == TripStatus.EXECUTING.value
    return _trip({**data, "status": TripStatus.WAITING.value} if flew else data, status)


def waits_for_a_drone(row: MissionRow) -> bool:
    """Return whether a mission has all that it takes to fly, but for a drone."""
    return row["wait"] is not None and row["wait"]["key"] in ("wait.drone", "wait.drone-full")


_WAITS = {
    Status.PAUSED: words("wait.paused", "paused"),
    **dict.fromkeys(ANSWERS, words("wait.you", "waits for your decision")),
}


def _question(status: Status, text: str, record: Record) -> Question | None:
    answers, flight = ANSWERS.get(status), record["flight"]
    if answers is None:
        return None
    trip = trip_of(record, flight)
    if status is Status.UNCERTAIN and trip is not None:
        action, drone = trip["action"], flight["drone"]
        said = words("question.action", text, action=action, trip=trip["name"], drone=drone)
    else:
        said = words("question.other", text, question=text)
    return {"said": said, "answers": list(answers)}
