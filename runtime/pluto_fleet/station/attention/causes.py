"""What there is to know of now, from the rows that pages are shown."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...flight.control import ANSWERS
from ...shared.domain.status import Status
from ...shared.domain.text import counted, cut_off, duration, percent, quoted

if TYPE_CHECKING:
    from ..wire import AlertKind, DroneRow, MissionRow, Point, Result, Scalar, Words

_ASKING = {status.value for status in ANSWERS}
_NAMED = 3
"""The most drones that a sentence names."""
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


def words(key: str, text: str, **facts: Scalar | list[str]) -> Words:
    """Return a sentence by the key of its translations, its facts, and the sentence in English."""
    return {"key": f"alert.{key}", "facts": facts, "text": text}


def of_drones(drones: Iterable[DroneRow], crashed: Collection[str]) -> Iterator[Cause]:
    """Yield the drones that are lost; `crashed` are those of which the gateway knows that they fell."""
    for row in drones:
        if row["status"] != "LOST":
            continue
        fell, id, why = row["id"] in crashed, row["id"], row["why"]
        text = f"{id} {'crashed' if fell else 'is lost'}" + (f": {why}" if why else "")
        kind: AlertKind = "crashed" if fell else "lost"
        at = None if row["x"] is None or row["y"] is None else [row["x"], row["y"]]
        said = words(kind, text, drone=id, why=why)
        yield Cause(kind=kind, about=id, said=said, urgent=True, drone=id, at=at)


def of_batteries(drones: Iterable[DroneRow], wait: bool) -> Iterator[Cause]:
    """Yield that drones are too low for what waits, while anything waits for a drone."""
    low = [row for row in drones if row["status"] == "LOW"]
    if not low or not wait:
        return
    ids, soonest = [row["id"] for row in low], first_ready(low)
    named = ", ".join(ids[:_NAMED]) + (
        f" and {len(ids) - _NAMED} more" if len(ids) > _NAMED else ""
    )
    one = len(ids) == 1
    text = f"the {'battery' if one else 'batteries'} of {named} {'is' if one else 'are'} too low for what waits"
    if soonest is None:
        text += f"; {'it does' if one else 'they do'} not charge: look whether {'it stands in its dock' if one else 'they stand in their docks'}"
    else:
        text += f"; {'it' if one else 'the first'} is ready in about {about(soonest)}"
    facts: dict[str, Scalar | list[str]] = {"drones": ids}
    if soonest is not None:
        facts["ready_in"] = soonest
    yield Cause(
        kind="battery",
        about="",
        said=words("battery", text, **facts),
        drone=ids[0] if one else None,
    )


def first_ready(drones: Iterable[DroneRow]) -> float | None:
    """Return in how many seconds the first of these drones is ready; None: none charges."""
    times = (row.get("ready_in") for row in drones)
    return min((seconds for seconds in times if seconds is not None), default=None)


def about(seconds: float) -> str:
    """Return a time that is expected, to the minute if it is long."""
    return duration(max(60, round(seconds / 60) * 60) if seconds > 90 else max(1, round(seconds)))


def of_missions(missions: Iterable[MissionRow]) -> Iterator[Cause]:
    """Yield the missions that ask something, that have failed, and that are late."""
    for row in missions:
        name, reason = row["name"], row["reason"]
        called = quoted(cut_off(name, _LONGEST_NAME))
        if row["status"] in _ASKING:
            question = row["question"]
            asked = question["text"] if question is not None else reason
            said = words(
                "uncertain",
                f"{called} needs you: {asked}",
                mission=name,
                question=asked,
                answers=question["answers"] if question is not None else [],
            )
            drone, at = row["drone"], _place_of(row)
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
            said = words("failed", text, mission=name, why=reason)
            yield Cause(kind="failed", about=name, said=said, mission=name, at=_place_of(row))
        elif row["late"] and row["at"] != ["end"]:
            due = row["due"]
            facts: dict[str, Scalar | list[str]] = {} if due is None else {"due": due}
            said = words("late", f"{called} is late", mission=name, **facts)
            yield Cause(kind="late", about=name, said=said, mission=name)


def _place_of(row: MissionRow) -> Point | None:
    current = row["current"]
    if current is None or not current < len(row["trips"]):
        return None
    trip = row["trips"][current]
    return [trip["x"], trip["y"]]


def of_results(findings: Iterable[Result]) -> Iterator[Cause]:
    """Yield the results in which something was found."""
    for one in findings:
        tags, trip = one["tags"], one["trip"] or ""
        text = f"{', '.join(tags)}: found by {quoted(cut_off(one['mission'], _LONGEST_NAME))}"
        text += f" at {one['place'] or trip}" if one["place"] or trip else ""
        said = words(
            "finding",
            text,
            tags=tags,
            mission=one["mission"],
            trip=trip,
            place=one["place"] or "",
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


def of_waiting(waiting: int, drones: Sequence[DroneRow], takes: float | None) -> Cause | None:
    """Return why so many missions have waited for long, in total; None: as all drones fly.

    `takes` is the level that the low drones need.
    """
    low = [row for row in drones if row["status"] == "LOW"]
    count = {
        "charging": _count(drones, "CHARGING"),
        "recovering": _count(drones, "RECOVERING"),
        "lost": _count(drones, "LOST"),
        "offline": _count(drones, "OFFLINE"),
        "retired": sum(row["retired"] and row["status"] != "LOST" for row in drones),
    }
    if not low and not any(count.values()):
        return None
    parts, facts = [], {"missions": waiting, "low": len(low)} | count
    timed: dict[str, Scalar | list[str]] = dict(facts)
    if low:
        are = "drone is" if len(low) == 1 else "drones are"
        if takes is not None and takes <= 1:
            parts.append(f"{len(low)} {are} below {percent(takes)}")
            timed["takes"] = takes
        else:
            parts.append(f"{len(low)} {are} too low")
        soonest = first_ready(low)
        if soonest is not None:
            parts.append(f"the first is ready in about {about(soonest)}")
            timed["ready_in"] = soonest
    flying = sum(row["status"] in ("BUSY", "RETURNING") for row in drones)
    timed["flying"] = flying
    said = {**count, "flying": flying}
    parts += [f"{number} {_SAID.get(what, what)}" for what, number in said.items() if number]
    text = (
        f"{counted(waiting, 'mission')} {'waits' if waiting == 1 else 'wait'}: {', '.join(parts)}"
    )
    return Cause(kind="waiting", about="", said=words("waiting", text, **timed))


_SAID = {"recovering": "being recovered", "offline": "not asked yet"}


def _count(drones: Iterable[DroneRow], status: str) -> int:
    return sum(row["status"] == status for row in drones)
