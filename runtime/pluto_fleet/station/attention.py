"""What a person must know of: what there is now, and the list of alerts, which outlives the station."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from ..flight.mission_status import ANSWERS
from ..process.whole_file import write_whole
from ..report.sentences import sentence_of
from ..shared.domain.errors import BadInput
from ..shared.domain.status import Status
from ..shared.domain.text import counted, cut_off, duration, percent, quoted
from .feed import VersionedRows
from .rows import waits_for_a_drone, words
from .wire import Alert

if TYPE_CHECKING:
    from ..shared.domain.trace import Event
    from .wire import (
        AlertKind,
        DroneRow,
        MissionRow,
        Point,
        Result,
        SaidKey,
        Scalar,
        Words,
    )

    Facts = dict[str, Scalar | list[str]]


_ASKING = {status.value for status in ANSWERS}
_LONGEST_NAME = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """A reason for an alert, which lasts as long as the reason does."""

    kind: AlertKind
    about: str
    """What it is about; with the kind it tells causes apart."""
    said: Words
    urgent: bool = False
    mission: str | None = None
    drone: str | None = None
    at: Point | None = None


def of_drones(drones: Iterable[DroneRow], crashed: Collection[str]) -> Iterator[Cause]:
    """Yield the drones that are lost; `crashed` are those of which the gateway knows that they fell."""
    for row in drones:
        if row["status"] != "LOST":
            continue
        fell = row["id"] in crashed
        id = row["id"]
        why = row["why"]
        text = f"{id} {'crashed' if fell else 'is lost'}" + (f": {why}" if why else "")
        kind: AlertKind = "crashed" if fell else "lost"
        at = None if row["x"] is None or row["y"] is None else [row["x"], row["y"]]
        said = words("alert.crashed" if fell else "alert.lost", text, drone=id, why=why)
        yield Cause(kind=kind, about=id, said=said, urgent=True, drone=id, at=at)


def of_reserves(drained: Iterable[tuple[int, Event]]) -> Iterator[Cause]:
    """Yield the drones that came home with less than their reserve, each time by its number."""
    for number, event in drained:
        id = str(event["drone"])
        level = float(str(event["level"]))
        said = words("alert.drained", sentence_of(event) or "", drone=id, level=level)
        yield Cause(kind="drained", about=str(number), said=said, drone=id)


def of_missions(missions: Iterable[MissionRow]) -> Iterator[Cause]:
    """Yield the missions that ask something, that have failed, and that are late."""
    for row in missions:
        name = row["name"]
        reason = row["reason"]
        called = quoted(cut_off(name, _LONGEST_NAME))
        if row["status"] in _ASKING:
            said = _uncertain(called, row)
            drone = row["drone"]
            at = _place_of(row)
            yield Cause(
                kind="uncertain",
                about=name,
                said=said,
                urgent=True,
                mission=name,
                drone=drone,
                at=at,
            )
        elif row["status"] == Status.FAILED.value:
            text = f"{called} has failed" + (f": {reason}" if reason else "")
            said = words("alert.failed", text, mission=name, why=reason)
            yield Cause(kind="failed", about=name, said=said, mission=name, at=_place_of(row))
        elif row["late"] and row["at"] != ["end"]:
            due = row["due"]
            facts: dict[str, Scalar | list[str]] = {} if due is None else {"due": due}
            said = words("alert.late", f"{called} is late", mission=name, **facts)
            yield Cause(kind="late", about=name, said=said, mission=name)


def _uncertain(called: str, row: MissionRow) -> Words:
    name = row["name"]
    question = row["question"]
    asked = row["reason"]
    answers = list[str]()
    facts: dict[str, Scalar | list[str]] = {"question": asked}
    key: SaidKey = "alert.uncertain"
    if question is not None:
        asked = question["said"]["text"]
        facts = question["said"]["facts"]
        answers = question["answers"]
        if question["said"]["key"] == "question.action":
            key = "alert.uncertain-action"
    return words(key, f"{called} needs you: {asked}", mission=name, answers=answers, **facts)


def _place_of(row: MissionRow) -> Point | None:
    current = row["current"]
    if current is None or not current < len(row["trips"]):
        return None
    trip = row["trips"][current]
    return [trip["x"], trip["y"]]


def of_results(findings: Iterable[Result]) -> Iterator[Cause]:
    """Yield the results in which something was found."""
    for one in findings:
        tags = one["tags"]
        trip = one["trip"] or ""
        text = f"{', '.join(tags)}: found by {quoted(cut_off(one['mission'], _LONGEST_NAME))}"
        text += f" at {one['place'] or trip}" if one["place"] or trip else ""
        said = words(
            "alert.finding",
            text,
            tags=tags,
            mission=one["mission"],
            trip=trip,
            place=one["place"] or "",
            where=one["place"] or trip,
            number=one["number"],
        )
        yield Cause(
            kind="finding",
            about=str(one["number"]),
            said=said,
            mission=one["mission"],
            drone=one["drone"],
            at=one["at"] or one["target"],
        )


LONG = 120.0
"""Seconds of a flight after which it is said why missions wait."""
_NAMED = 3
_SHORT = 90.0
"""Seconds: what is expected later is told to the minute."""


class Waits:
    """Since when each mission of a flight waits for a drone, in its time."""

    def __init__(self) -> None:
        self._since: dict[str, float] = {}

    def look(self, missions: Iterable[MissionRow], now: float) -> int:
        """Return how many wait, if one of them has for long; else 0."""
        waiting = [row["name"] for row in missions if waits_for_a_drone(row)]
        self._since = {name: self._since.get(name, now) for name in waiting}
        longest = max((now - since for since in self._since.values()), default=0.0)
        return len(waiting) if longest >= LONG else 0

    @property
    def any(self) -> bool:
        """Whether any mission waits for a drone."""
        return bool(self._since)


def of_waiting(waiting: int, drones: Sequence[DroneRow], takes: float | None) -> Cause | None:
    """Return why so many missions have waited for long; None: as all drones fly.

    `takes` is the level that the low drones need.
    """
    low = _low(drones)
    soonest = None
    count = {
        "charging": _count(drones, "CHARGING"),
        "recovering": _count(drones, "RECOVERING"),
        "lost": _count(drones, "LOST"),
        "offline": _count(drones, "OFFLINE"),
        "retired": sum(row["retired"] and row["status"] != "LOST" for row in drones),
    }
    if not low and not any(count.values()):
        return None
    count["flying"] = _count(drones, "BUSY", "RETURNING")
    facts: Facts = {"missions": waiting, "low": len(low), **count}
    parts = []
    if low:
        are = "drone is" if len(low) == 1 else "drones are"
        if takes is not None and takes <= 1:
            facts["takes"] = ceil(takes * 100) / 100
            parts.append(f"{len(low)} {are} below {percent(ceil(takes * 100) / 100)}")
        else:
            parts.append(f"{len(low)} {are} too low")
        soonest = _first_ready(low)
    if soonest is not None:
        facts["ready_in"] = soonest
        parts.append(f"the first is ready in about {duration(soonest)}")
    parts += [f"{number} {_SAID.get(what, what)}" for what, number in count.items() if number]
    wait = "waits" if waiting == 1 else "wait"
    text = f"{counted(waiting, 'mission')} {wait}: {', '.join(parts)}"
    return Cause(kind="waiting", about="", said=words("alert.waiting", text, **facts))


_SAID = {"recovering": "being recovered", "offline": "not asked yet"}


def of_batteries(drones: Sequence[DroneRow], wait: bool) -> Iterator[Cause]:
    """Yield that drones are too low for what waits, while anything does."""
    ids = [row["id"] for row in _low(drones)]
    if not ids or not wait:
        return
    soonest = _first_ready(_low(drones))
    one = len(ids) == 1
    facts: Facts = {"drones": ids}
    named = ", ".join(ids[:_NAMED])
    named += f" and {len(ids) - _NAMED} more" if len(ids) > _NAMED else ""
    text = f"the battery of {named} is" if one else f"the batteries of {named} are"
    text += " too low for what waits; "
    if soonest is not None:
        facts["ready_in"] = soonest
        text += f"{'it' if one else 'the first'} is ready in about {duration(soonest)}"
    elif one:
        text += "it does not charge: look whether it stands in its dock"
    else:
        text += "they do not charge: look whether they stand in their docks"
    said = words("alert.battery-stays" if soonest is None else "alert.battery", text, **facts)
    yield Cause(kind="battery", about="", said=said, drone=ids[0] if one else None)


def _low(drones: Iterable[DroneRow]) -> list[DroneRow]:
    return [row for row in drones if row["status"] == "LOW"]


def _count(drones: Iterable[DroneRow], *statuses: str) -> int:
    return sum(row["status"] in statuses for row in drones)


def _first_ready(drones: Iterable[DroneRow]) -> int | None:
    """Return in about how many seconds the first of these drones is ready; None: none charges."""
    times = (row.get("ready_in") for row in drones)
    soonest = min((seconds for seconds in times if seconds is not None), default=None)
    if soonest is None:
        return None
    return max(1, round(soonest)) if soonest < _SHORT else 60 * round(soonest / 60)


FILE = "attention.json"
KEPT = 200
"""The most alerts that are kept: of those that are over, the oldest are forgotten first."""
OF_A_DRONE = ("lost", "crashed")
"""The kinds of alerts that last from one flight to the next."""
ONCE = ("finding", "drained")
"""The kinds of alerts of what has happened, and is over once a person knows of it."""


class Attention:
    """The alerts of a station, in a file of its folder."""

    def __init__(self, file: Path, now: Callable[[], float]) -> None:
        """`now` is in seconds since 1970."""
        self._file = file
        self._now = now
        self.rows: VersionedRows[Alert] = VersionedRows()
        self._alerts: dict[str, Alert] = {one["id"]: one for one in _kept(file)}
        self._open = {_key(id): id for id, one in self._alerts.items() if not one["over"]}
        self._told = False

    def look(self, flight: str, causes: Iterable[Cause], version: int) -> bool:
        """Note what has arisen, changed and ended; return whether anything has.

        What has happened once is over when it has been acknowledged, anything else when its cause is.
        """
        found = {_named(flight, one): one for one in causes}
        changed = arisen = False
        for key, cause in found.items():
            if key in self._open:
                changed |= self._update(self._alerts[self._open[key]], cause)
            elif cause.kind not in ONCE or f"{key}/1" not in self._alerts:
                arisen = True
                self._arise(key, cause)
        for key, id in list(self._open.items()):
            alert = self._alerts[id]
            known = alert["by_at"] is not None
            if key not in found or (known and alert["kind"] in ONCE):
                alert["over"] = True
                arisen = True
                del self._open[key]
        self._forget(found.keys())
        if arisen:
            self._keep()
        if arisen or changed or not self._told:
            self._told = changed = True
            for id, alert in self._alerts.items():
                self.rows.put(id, {**alert}, version)
        return arisen or changed

    def acknowledge(self, id: str, by: str) -> str:
        """Note that a person knows of an alert; `by` is their name, if they have said one."""
        alert = self._alerts.get(id)
        if alert is None:
            raise BadInput(f"there is no alert {quoted(id)} any more")
        if alert["by_at"] is not None:
            return f"acknowledged already{_by(alert['by'])}"
        alert["by"], alert["by_at"] = by, round(self._now() * 1000)
        self._told = False
        self._keep()
        return f"acknowledged{_by(by)}"

    def _arise(self, key: str, cause: Cause) -> None:
        number = 1
        while f"{key}/{number}" in self._alerts:
            number += 1
        id = f"{key}/{number}"
        x, y, *_ = cause.at if cause.at is not None else (None, None)
        self._alerts[id] = {
            "id": id,
            "kind": cause.kind,
            "urgent": cause.urgent,
            "mission": cause.mission,
            "drone": cause.drone,
            "x": x,
            "y": y,
            "since_at": round(self._now() * 1000),
            "said": cause.said,
            "over": False,
            "by": None,
            "by_at": None,
        }
        self._open[key] = id

    def _update(self, alert: Alert, cause: Cause) -> bool:
        """Say what is so by now; the sentence changes while an alert lasts."""
        if alert["said"] == cause.said:
            return False
        alert["said"] = cause.said
        return True

    def _forget(self, found: Collection[str]) -> None:
        """Forget what is over, but not what would arise again."""
        over = [id for id, one in self._alerts.items() if one["over"] and _key(id) not in found]
        for id in over[: max(0, len(self._alerts) - KEPT)]:
            del self._alerts[id]
            self.rows.drop(id)

    def _keep(self) -> None:
        text = json.dumps(list(self._alerts.values()))
        with suppress(OSError):  # what they are about is in the journals, too
            write_whole(self._file, text)


def _named(flight: str, cause: Cause) -> str:
    """Return what tells a cause apart from all others of this station."""
    return "/".join(["" if cause.kind in OF_A_DRONE else flight, cause.kind, cause.about])


def _key(id: str) -> str:
    return id.rpartition("/")[0]


def _by(name: str | None) -> str:
    return f" by {name}" if name else ""


def _kept(file: Path) -> list[Alert]:
    """Return the alerts of an earlier station; none if they cannot be read."""
    with suppress(OSError, ValueError):
        return msgspec.json.decode(file.read_bytes(), type=list[Alert])
    return []
