"""Where missions stand after some events: for journals that tests write by hand, whose rows must follow from them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from pluto_fleet.journal.standing import Record

Event = Mapping[str, Any]


class Told:
    """How missions stand after the events that were taken."""

    def __init__(self) -> None:
        self.missions: dict[str, Record] = {}

    def take(self, event: Event) -> None:
        """Take an event."""
        change = _MISSION.get(event["event"])
        if change is not None:
            change(self.missions.setdefault(event["mission"], _new({})), event)


def _new(plan: Mapping[str, Any]) -> Record:
    return {
        "index": plan.get("index", 0),
        "fields": plan.get("fields", {}),
        "status": "UNEXECUTED",
        "reason": "",
        "round": 0,
        "attempts": 0,
        "todo": [dict(trip) for trip in plan.get("trips", ())],
        "done": [],
        "gone": [],
        "at": None,
        "flight": None,
        "carrier": None,
        "ended": False,
        "paused": None,
        "question": None,
        "held": None,
        "promises": plan.get("promises", {}),
        "late": False,
    }


def _created(record: Record, event: Event) -> None:
    record.update(_new(event["plan"]), late=record["late"])


def _late(record: Record, event: Event) -> None:
    record["late"] = True


def _changed(record: Record, event: Event) -> None:
    at = event["at"]
    gone = len(event["gone"])
    _replace(record, [*record["todo"][:at], *event["put"], *record["todo"][at + gone :]])
    record["fields"] = event["fields"]


def _replanned(record: Record, event: Event) -> None:
    _replace(record, event["todo"])


def _replace(record: Record, todo: Iterable[Record]) -> None:
    """Put other trips in place of those to do."""
    before = record["todo"]
    record["todo"] = [dict(trip) for trip in todo]
    names = {trip["name"] for trip in record["todo"]}
    record["gone"] += [trip for trip in before if trip["name"] not in names]


def _waits(record: Record, event: Event) -> None:
    record["at"] = event["resumes_at"]


def _launched(record: Record, event: Event) -> None:
    record["flight"] = {
        "trip": event["trip"],
        "drone": event["drone"],
        "outcome": None,
        "heard": False,
    }
    record["attempts"] += 1
    record.update(status="RUNNING", reason="")
    _trip(record, event).update(status="EXECUTING", attempt=event["attempt"])


def _completed(record: Record, event: Event) -> None:
    trip = _trip(record, event)
    record["todo"] = [one for one in record["todo"] if one is not trip]
    trip.pop("status", None)
    record["done"].append(trip)
    did = event["did"]
    if did.get("item") is not None:
        record["carrier"] = event["drone"] if did["action"] == "pick_item" else None
    _over(record, "STANDBY" if record["todo"] else "COMPLETED", "")


def _failed(record: Record, event: Event) -> None:
    _trip(record, event).update(status="FAILED", reason=event["reason"])
    record["carrier"] = None
    _over(record, "FAILED", event["reason"])


def _over(record: Record, status: str, reason: str) -> None:
    record.update(status=status, reason=reason, question=None)
    if record["flight"] is not None:
        record["flight"]["outcome"] = status


def _put_back(record: Record, event: Event) -> None:
    trip = _trip(record, event)
    trip.pop("status", None)
    trip["attempt"] = event.get("attempt", trip.get("attempt", 1))
    trip["fields"] = event.get("fields", trip.get("fields", {}))
    record.update(status="STANDBY", reason="")


def _interrupted(record: Record, event: Event) -> None:
    _put_back(record, event)
    record["attempts"] -= 1
    _over(record, "STANDBY", "")


def _skipped(record: Record, event: Event) -> None:
    trip = _trip(record, event)
    record["todo"] = [one for one in record["todo"] if one is not trip]
    record["gone"].append(trip)


def _prioritised(record: Record, event: Event) -> None:
    trip = _trip(record, event)
    trip["fields"] = {**trip.get("fields", {}), "priority": event["priority"]}


def _extended(record: Record, event: Event) -> None:
    again = [trip for trip in record["done"] if trip["name"] in event["redo"]]
    record["done"] = [trip for trip in record["done"] if trip not in again]
    record["todo"] += [*again, *(dict(trip) for trip in event["trips"])]
    record.update(status="STANDBY", reason="")


def _repeated(record: Record, event: Event) -> None:
    own = [trip for trip in record["done"] if not trip.get("added")]
    record["gone"] += [trip for trip in record["done"] if trip.get("added")]
    trips = sorted([*record["todo"], *own], key=lambda trip: int(trip["index"]))
    record.update(todo=trips, done=[], round=event["round"], status="STANDBY", reason="")


def _stands(record: Record, event: Event) -> None:
    record.update(status=event["status"], reason=event.get("reason", ""))


def _judged(record: Record, event: Event) -> None:
    record.update(status="FAILED", reason=event["reason"])


def _ended(record: Record, event: Event) -> None:
    _stands(record, event)
    record.update(ended=True, carrier=None, question=None, held=None, paused=None)


def _paused(record: Record, event: Event) -> None:
    record["paused"] = event["t"]


def _resumed(record: Record, event: Event) -> None:
    record.update(paused=None, held=None, question=None, status=event["status"])


def _uncertain(record: Record, event: Event) -> None:
    record.update(question=event["reason"], held=None)


def _held(record: Record, event: Event) -> None:
    record["held"] = event["reason"]


def _trip(record: Record, event: Event) -> Record:
    trips = (*record["todo"], *record["done"], *record["gone"])
    found: Record = next(trip for trip in trips if trip["name"] == event["trip"])
    return found


_MISSION: Mapping[str, Callable[[Record, Event], None]] = {
    "mission.promised": _created,
    "mission.created": _created,
    "mission.late": _late,
    "mission.changed": _changed,
    "mission.replanned": _replanned,
    "trip.delayed": _waits,
    "trip.allocated": _waits,
    "trip.launched": _launched,
    "trip.completed": _completed,
    "trip.failed": _failed,
    "trip.reset": _put_back,
    "trip.interrupted": _interrupted,
    "trip.skipped": _skipped,
    "trip.prioritised": _prioritised,
    "mission.extended": _extended,
    "mission.repeated": _repeated,
    "mission.modified": _stands,
    "mission.judged": _judged,
    "mission.ended": _ended,
    "mission.paused": _paused,
    "mission.resumed": _resumed,
    "mission.uncertain": _uncertain,
    "mission.held": _held,
}
