"""What there is to know of now, from the rows that pages are shown."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...flight.control import ANSWERS
from ...report.sentences import sentence_of
from ...shared.domain.status import Status
from ...shared.domain.text import cut_off, quoted
from ..words import words

if TYPE_CHECKING:
    from ...shared.domain.trace import Event
    from ..wire import (
        AlertKind,
        DroneRow,
        MissionRow,
        Point,
        Result,
        SaidKey,
        Scalar,
        Words,
    )

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
        fell, id, why = row["id"] in crashed, row["id"], row["why"]
        text = f"{id} {'crashed' if fell else 'is lost'}" + (f": {why}" if why else "")
        kind: AlertKind = "crashed" if fell else "lost"
        at = None if row["x"] is None or row["y"] is None else [row["x"], row["y"]]
        said = words("alert.crashed" if fell else "alert.lost", text, drone=id, why=why)
        yield Cause(kind=kind, about=id, said=said, urgent=True, drone=id, at=at)


def of_reserves(drained: Iterable[tuple[int, Event]]) -> Iterator[Cause]:
    """Yield the drones that came home with less than their reserve, each time by its number."""
    for number, event in drained:
        id, level = str(event["drone"]), float(str(event["level"]))
        said = words("alert.drained", sentence_of(event) or "", drone=id, level=level)
        yield Cause(kind="drained", about=str(number), said=said, drone=id)


def of_missions(missions: Iterable[MissionRow]) -> Iterator[Cause]:
    """Yield the missions that ask something, that have failed, and that are late."""
    for row in missions:
        name, reason = row["name"], row["reason"]
        called = quoted(cut_off(name, _LONGEST_NAME))
        if row["status"] in _ASKING:
            said = _uncertain(called, row)
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
            said = words("alert.failed", text, mission=name, why=reason)
            yield Cause(kind="failed", about=name, said=said, mission=name, at=_place_of(row))
        elif row["late"] and row["at"] != ["end"]:
            due = row["due"]
            facts: dict[str, Scalar | list[str]] = {} if due is None else {"due": due}
            said = words("alert.late", f"{called} is late", mission=name, **facts)
            yield Cause(kind="late", about=name, said=said, mission=name)


def _uncertain(called: str, row: MissionRow) -> Words:
    name, question = row["name"], row["question"]
    asked, answers = row["reason"], list[str]()
    facts: dict[str, Scalar | list[str]] = {"question": asked}
    key: SaidKey = "alert.uncertain"
    if question is not None:
        asked, facts, answers = (
            question["said"]["text"],
            question["said"]["facts"],
            question["answers"],
        )
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
        tags, trip = one["tags"], one["trip"] or ""
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
