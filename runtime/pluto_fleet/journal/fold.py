"""Folding a journal's events into records: the state and the history of every mission.

The records are plain data: as JSON they are the journal's snapshot. There is one function for each event;
an event without one changes nothing that must survive.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from ..shared.domain.actions import PICK, RELEASE
from . import errors
from .facts import BEGUN, check, snapshot_of

if TYPE_CHECKING:
    from pathlib import Path

    from .database import Row
    from .facts import Event
    from .reader import Read


Record = dict[str, Any]
"""One mission. Its trips are as in `values.trip_data`."""

Fact = Mapping[str, Any]

BROKEN = (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, StopIteration)
"""What an event raises that is not as this version knows it."""

REMEMBERED = 200
"""How many command ids are remembered: older ones are not repeated."""


class Records:
    """The records of one journal, as far as it has been read."""

    def __init__(self, data: Record | None = None) -> None:
        self.data: Record = data or {
            "t": 0.0,
            "missions": {},
            "results": [],
            "flown": {},
            "lives": 0,
            "stopped": None,
        }
        self.missions: dict[str, Record] = self.data["missions"]
        self.results: list[list[Any]] = self.data["results"]
        """[mission, trip, round, attempt, value] of every action that was done."""
        self.flown: dict[str, int] = self.data["flown"]
        """How many trips each drone has flown."""
        self.commands: list[str] = self.data.setdefault("commands", [])
        """The ids of the last commands, as chosen by their senders."""
        self.retired: list[str] = self.data.setdefault("retired", [])
        """The retired drones."""
        self.mended: list[str] = self.data.setdefault("mended", [])
        """The drones that were lost and repaired, and are not back yet."""
        self.joined: list[Record] = self.data.setdefault("joined", [])
        """The drones that have joined the fleet, in their order, each as in a fleet file."""
        self.clock: Record = self.data.setdefault("clock", {"began": None, "drift": 0.0})
        """When the app first began, by the clock of the hours, and how far that has drifted since."""
        self.lost: dict[str, Record] = self.data.setdefault("lost", {})
        """The drones that no trip may have before a person has looked after them: why, and where
        each was when it was lost."""

    @property
    def time(self) -> float:
        """The time of the last event, in seconds since the app first started."""
        return float(self.data["t"])

    @property
    def stopped(self) -> bool:
        """Whether everything was stopped by a command, and not resumed since."""
        return self.data["stopped"] is not None

    @property
    def drones(self) -> set[str]:
        """The drones that missions have which have not ended, without those that have joined."""
        living = [record for record in self.missions.values() if not record["ended"]]
        flown = {record["flight"]["drone"] for record in living if record["flight"] is not None}
        carriers = {record["carrier"] for record in living if record["carrier"] is not None}
        return (flown | carriers) - {str(entry.get("id")) for entry in self.joined}

    def flown_last(self, mission: str) -> Record:
        """Return the trip that a mission completed last."""
        trip: Record = self.missions[mission]["done"][-1]
        return trip

    def read(self, event: Fact) -> None:
        """Process an event of a journal; raise `ValueError` if it is not as this version knows it."""
        check(event)
        try:
            self.take(event)
        except BROKEN as error:
            raise ValueError(errors.does_not_follow(event["event"], error)) from None

    def take(self, event: Fact) -> None:
        """Process an event of this run."""
        kind = event["event"]
        self.data["t"] = event["t"]
        change = _MISSION.get(kind)
        if change is not None:
            name = event["mission"]
            record = self.missions.get(name)
            if record is None:
                record = self.missions[name] = _new()
            change(self, record, event)
        elif kind in _WHOLE:
            _WHOLE[kind](self, event)


def _new() -> Record:
    return {
        "index": 0,
        "fields": {},
        "status": "UNEXECUTED",
        "reason": "",
        "round": 0,
        "attempts": 0,
        "todo": [],
        "done": [],
        "gone": [],
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


def _created(_: Records, record: Record, event: Fact) -> None:
    plan, gone = event["plan"], record["gone"]  # it may restart, but without skipped trips
    record.update(_new(), late=record["late"])
    record.update(index=plan["index"], fields=plan["fields"], todo=plan["trips"], gone=gone)
    record["promises"] = plan.get("promises", {})


def _late(_: Records, record: Record, event: Fact) -> None:
    record["late"] = True


def _changed(_: Records, record: Record, event: Fact) -> None:
    """Take over a mission that a hook has changed."""
    at = event["at"]
    todo = record["todo"]
    done = record["done"]
    old = todo[at : at + len(event["gone"])]
    if [trip["name"] for trip in old] != event["gone"]:
        raise KeyError(f"other trips than {event['gone']} at {at}")
    flown = {trip["name"]: _flown(trip) for trip in old if trip.get("status") in _HAVE_FLOWN}
    put = [{**flown.get(trip["name"], {}), **trip} for trip in event["put"]]
    todo[at : at + len(old)] = put
    names = {trip["name"] for trip in todo}
    _leave(record, [trip for trip in old if trip["name"] not in names])
    for trip in event["done"]:
        place = next(n for n, one in enumerate(done) if one["name"] == trip["name"])
        done[place] = {**_flown(done[place]), **trip}
    record.update(fields=event["fields"], changed=True)


def _flown(trip: Record) -> Record:
    return {fact: trip[fact] for fact in ("start_time", "end_time", "reason") if fact in trip}


_HAVE_FLOWN = ("EXECUTING", "FAILED")


def _leave(record: Record, trips: list[Record]) -> None:
    """Note trips that are gone, and the round: in that their names are taken."""
    record["gone"] += [{**trip, "round": record["round"]} for trip in trips]


def _replanned(_: Records, record: Record, event: Fact) -> None:
    """Take over what a person has put in place of the trips that had not flown."""
    flight, last, todo = record["flight"], record["todo"][0], event["todo"]
    if last["name"] != todo[0]["name"] and flight and flight["outcome"]:
        _goes_on(record)
    if any(last.get(fact) != todo[0].get(fact) for fact in ("name", "fields")):
        record["delay"] = None  # it was the delay of another trip, or another delay
    names = {trip["name"] for trip in todo}
    old = (*record["gone"], *record["todo"])
    record["gone"] = []
    _leave(record, [trip for trip in old if trip["name"] not in names])
    record.update(todo=todo, replanned=True)


def _delayed(_: Records, record: Record, event: Fact) -> None:
    _goes_on(record)
    trip = _trip(record, event)
    place = [event["block"], trip["name"], record["round"], trip.get("attempt", 1)]
    record["at"], record["delay"] = event["resumes_at"], [place, event["over"], event["begins"]]


def _allocated(records: Records, record: Record, event: Fact) -> None:
    _goes_on(record)
    if record["delay"] is not None:
        place, over, begins = record["delay"]
        record["waited"].append(place)
        record["delay"] = None
        if record["first_start"] is None:
            record["first_start"] = max(over + records.clock["drift"], begins)
    if record["first_start"] is None:
        record["first_start"] = event["t"] + records.clock["drift"]
    record["at"] = event["resumes_at"]


def _launched(records: Records, record: Record, event: Fact) -> None:
    last, name, drone = record["flight"], event["trip"], event["drone"]
    record["flight"] = {
        "trip": name,
        "drone": drone,
        "round": event["round"],
        "attempt": event["attempt"],
        "since": event["t"],
        "retry": last is not None and last["trip"] == name and last["outcome"] == "FAILED",
        "begun": False,
        "outcome": None,
        "heard": False,
    }
    record["status"], record["reason"] = "RUNNING", ""
    record["attempts"] += 1
    trip = _trip(record, event)
    trip["status"], trip["start_time"] = "EXECUTING", event["t"]
    trip.pop("end_time", None)
    records.flown[drone] = records.flown.get(drone, 0) + 1


def _begun(_: Records, record: Record, event: Fact) -> None:
    record["flight"]["begun"] = True


def _beside(_: Records, record: Record, event: Fact) -> None:
    record["flight"]["beside"] = event["at"]


def _completed(records: Records, record: Record, event: Fact) -> None:
    trip = _take(record["todo"], event["trip"])
    _waits(trip)  # completed: nothing more is needed of it
    record["done"].append(trip)
    record["last_action_end"] = event["t"]
    result = [event["mission"], event["trip"], event["round"], event["attempt"], event["result"]]
    records.results.append(result)
    if trip["action"] == PICK:
        record["carrier"], record["carries"] = event["drone"], trip["item"]
    elif trip["action"] == RELEASE:
        record["carrier"] = record["carries"] = None
    _outcome(record, "STANDBY" if record["todo"] else "COMPLETED", "")


def _failed(_: Records, record: Record, event: Fact) -> None:
    _trip(record, event).update(status="FAILED", end_time=event["t"], reason=event["reason"])
    record["carrier"] = record["carries"] = None
    _outcome(record, "FAILED", event["reason"])


def _outcome(record: Record, status: str, reason: str) -> None:
    record["status"], record["reason"] = status, reason
    record["question"] = record["answer"] = None
    if record["flight"] is not None:
        record["flight"]["outcome"] = status


def _reset(_: Records, record: Record, event: Fact) -> None:
    _goes_on(record)
    trip = _trip(record, event)
    trip.update(attempt=event["attempt"], fields=event["fields"])
    _waits(trip)
    record.update(status="STANDBY", reason="")


def _interrupted(_: Records, record: Record, event: Fact) -> None:
    _goes_on(record)
    _waits(_trip(record, event))
    record["attempts"] -= 1
    record["interrupted"] = True
    record.update(status="STANDBY", reason="", question=None, answer=None)


def _skipped(_: Records, record: Record, event: Fact) -> None:
    flight = record["flight"]
    if flight and flight["outcome"] and record["todo"][0]["name"] == event["trip"]:
        _goes_on(record)
    _leave(record, [_take(record["todo"], event["trip"])])


def _prioritised(_: Records, record: Record, event: Fact) -> None:
    _trip(record, event).setdefault("fields", {})["priority"] = event["priority"]


def _extended(records: Records, record: Record, event: Fact) -> None:
    _goes_on(record)
    record["judged"] = len(records.results)
    record["changed"] = True
    for name in event["redo"]:
        trip = _take(record["done"], name)
        trip["attempt"] = trip.get("attempt", 1) + 1
        _waits(trip)
        record["todo"].append(trip)
    record["todo"] += event["trips"]
    record.update(status="STANDBY", reason="")


def _repeated(records: Records, record: Record, event: Fact) -> None:
    _goes_on(record)
    own = [trip for trip in record["done"] if not trip.get("added")]
    for trip in own:
        _waits(trip)
    record["gone"] += [trip for trip in record["done"] if trip.get("added")]
    record["todo"] = sorted([*record["todo"], *own], key=lambda trip: int(trip["index"]))
    for trip in record["todo"]:
        if "status" not in trip:  # it waits
            trip["attempt"] = 1
    record["judged"] = len(records.results)
    record["waited"] = []
    record.update(done=[], round=event["round"], last_action_end=None, status="STANDBY", reason="")


def _modified(_: Records, record: Record, event: Fact) -> None:
    record.update(status=event["status"], reason=event["reason"])
    if event["status"] in ("STANDBY", "UNEXECUTED"):
        _goes_on(record)


def _judged(_: Records, record: Record, event: Fact) -> None:
    record.update(status="FAILED", reason=event["reason"])


def _ended(_: Records, record: Record, event: Fact) -> None:
    record.update(status=event["status"], reason=event["reason"], ended=True)
    record.update(carrier=None, carries=None, question=None, held=None, paused=None, delay=None)


def _paused(_: Records, record: Record, event: Fact) -> None:
    if record["paused"] is None:  # else it is repeated by a later run
        record["paused"] = event["t"]


def _resumed(_: Records, record: Record, event: Fact) -> None:
    if record["paused"] is not None and record["delay"] is not None:
        record["delay"][1] += event["t"] - record["paused"]
    record.update(paused=None, held=None, question=None, answer=None, status=event["status"])


def _uncertain(_: Records, record: Record, event: Fact) -> None:
    record.update(question=event["reason"], held=None, answer=None)


def _held(_: Records, record: Record, event: Fact) -> None:
    record["held"] = event["reason"]


def _decided(_: Records, record: Record, event: Fact) -> None:
    record["answer"] = event["answer"]
    if event["answer"] == "go-on":
        record["accepted"] = record["at"]  # this block may not exist any more


def _inherited(records: Records, event: Fact) -> None:
    """Take over the drones' states from earlier flights: a new journal repairs no drone."""
    records.lost.update(event.get("lost") or {})
    records.mended += event.get("mended") or []
    records.retired += event.get("retired") or []
    records.joined += event.get("joined") or []


def _began(records: Records, event: Fact) -> None:
    """A run begins: delays interrupted by a Stop keep their remaining time."""
    if records.stopped:
        shift_delays(records, float(event["t"]) - float(records.data["stopped"]))
    records.data["stopped"] = None
    records.data["lives"] += 1
    if "began" in event:
        records.clock.update(began=event["began"], drift=event["drift"])


def _clock_moved(records: Records, event: Fact) -> None:
    records.clock["drift"] = event["drift"]


def _stopped(records: Records, event: Fact) -> None:
    records.data["stopped"] = event["t"]


def _commanded(records: Records, event: Fact) -> None:
    """Remember a command's id: a sender that has missed the answer may repeat it."""
    records.commands.append(str(event["id"]))
    del records.commands[:-REMEMBERED]


def _joined(records: Records, event: Fact) -> None:
    records.joined.append(dict(event["entry"]))


def _retired(records: Records, event: Fact) -> None:
    if event["drone"] not in records.retired:
        records.retired.append(str(event["drone"]))


def _brought_back(records: Records, event: Fact) -> None:
    if event["drone"] in records.retired:
        records.retired.remove(str(event["drone"]))
    if event.get("lost"):
        records.lost.pop(str(event["drone"]), None)
        if event["drone"] not in records.mended:
            records.mended.append(str(event["drone"]))


def _came_back(records: Records, event: Fact) -> None:
    """Called when a drone is back: its repair is settled."""
    if event["drone"] in records.mended:
        records.mended.remove(str(event["drone"]))


def _lost(records: Records, event: Fact) -> None:
    """Mark a drone as lost; if it already was, the first reason counts."""
    _came_back(records, event)
    found = {"reason": event.get("reason", ""), "at": event.get("at")}
    records.lost.setdefault(str(event["drone"]), found)


def shift_delays(records: Records, seconds: float) -> None:
    """Postpone every pending delay by the seconds in which the app did not run."""
    for record in records.missions.values():
        if record["delay"] is not None:
            record["delay"][1] += seconds
        if record["paused"] is not None:
            record["paused"] += seconds


def _goes_on(record: Record) -> None:
    """Note that the mission has processed the end of its last flight."""
    if record["flight"] is not None:
        record["flight"]["heard"] = True


def _trip(record: Record, event: Fact) -> Record:
    name = event["trip"]
    for trips in record["todo"], record["done"], record["gone"]:
        for trip in trips:
            if trip["name"] == name:
                found: Record = trip
                return found
    raise KeyError(name)


def _waits(trip: Record) -> None:
    for fact in ("status", "start_time", "end_time"):
        trip.pop(fact, None)


def _take(trips: list[Record], name: str) -> Record:
    for place, trip in enumerate(trips):
        if trip["name"] == name:
            return trips.pop(place)
    raise KeyError(name)


_MISSION: dict[str, Callable[[Records, Record, Fact], None]] = {
    "mission.promised": _created,
    "mission.created": _created,
    "mission.late": _late,
    "mission.changed": _changed,
    "mission.replanned": _replanned,
    "trip.delayed": _delayed,
    "trip.allocated": _allocated,
    "trip.launched": _launched,
    "trip.beside": _beside,
    "action.begun": _begun,
    "trip.completed": _completed,
    "trip.failed": _failed,
    "trip.reset": _reset,
    "trip.interrupted": _interrupted,
    "trip.skipped": _skipped,
    "trip.prioritised": _prioritised,
    "mission.extended": _extended,
    "mission.repeated": _repeated,
    "mission.modified": _modified,
    "mission.judged": _judged,
    "mission.ended": _ended,
    "mission.paused": _paused,
    "mission.resumed": _resumed,
    "mission.uncertain": _uncertain,
    "mission.held": _held,
    "mission.decided": _decided,
}

_WHOLE: dict[str, Callable[[Records, Fact], None]] = {
    "journal.begun": _inherited,
    "brain.began": _began,
    "clock.moved": _clock_moved,
    "stopped": _stopped,
    "commanded": _commanded,
    "drone.joined": _joined,
    "drone.retired": _retired,
    "drone.brought_back": _brought_back,
    "drone.free": _came_back,
    "drone.charging": _came_back,
    "drone.lost": _lost,
}


def replayed(read: Read, header: Mapping[str, Any] | None = None) -> Records:
    """Return the records of a journal: of its header or a snapshot, and all events since.

    Check afterwards whether `read` was damaged: then these are the records up to the damage.
    """
    records = Records()
    number = read.after
    with _without_collections():
        try:
            if read.snapshot is not None:
                records = Records(snapshot_of(read.snapshot))
            elif header is not None:
                records.read({"t": 0.0, **header, "event": BEGUN})
            for row in read.rows:
                number = row.seq
                for event in row.events:
                    records.read(event)
        except ValueError as error:
            read.damaged = errors.unfit(number, error)
    return records


def taken(path: Path, rows: Iterable[Row], records: Records) -> Iterator[tuple[Row, Event]]:
    """Yield the events of rows, after each has been taken into the records.

    Of a `trip.completed`, `did` is the trip. Raises a `JournalError` at one that this version does not know.
    """
    for row in rows:
        try:
            for event in row.events:
                records.read(event)
                if event["event"] == "trip.completed":
                    event["did"] = records.flown_last(event["mission"])
                yield row, event
        except ValueError as error:
            raise errors.strange(path, errors.unfit(row.seq, error)) from None


@contextmanager
def _without_collections() -> Iterator[None]:
    """Disable the garbage collector: plain data has no cycles, and it would traverse all of it."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
