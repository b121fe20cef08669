"""`tell` and `decide`: commands for a running app, and answers to its questions."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from datetime import time as time_of_day
from pathlib import Path
from typing import TYPE_CHECKING

from ..files.reading import listed, read
from ..flight import offline
from ..flight.kept_events import OF_AN_EVENT, record_event
from ..flight.mission_status import ANSWERS, records_in, waiting
from ..flight.offline import record_decision
from ..gateway.starting import cut_directly, stop_directly
from ..jobs.link import MISHAPS
from ..jobs.reports import Down
from ..journal.errors import missing
from ..journal.lock import holder
from ..journal.place import commands_note, gateway_folder
from ..process.ipc import AnswerLost, NoAnswer, NotRunning, ask
from ..process.text import in_shell
from ..report.report import waiting_lines
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.text import printable, quoted

if TYPE_CHECKING:
    from ..app import App
    from ..journal.standing import Standing
    from .options import Options


STOP_DIRECTLY_AFTER = 1.0
"""Seconds until a Stop goes directly to the gateway."""

ANSWER_WITHIN = 10.0
"""The time-out of any other command, in seconds."""


def tell(app: App, options: Options) -> int:
    """Send a command to the running app, and print its answer."""
    request = _request(app, options)
    if options.action == "stop":
        output.line(_stop(app, options, request))
    elif options.action == "cut-motors":
        output.line(cut_motors(app, options.the_journal, options.mission))
    elif options.action == "bring-back":
        output.line(_bring_back(app, options, request))
    elif options.action == "event":
        output.line(_raise_event(app, options, request))
    else:
        output.line(asked(app, options, request))
    return 0


def _bring_back(app: App, options: Options, request: Mapping[str, object]) -> str:
    """Tell the running app, or its journal, that a drone has been repaired."""
    try:
        return asked(app, options, request)
    except NotRunning:
        return offline.record_return(app, options.the_journal, str(request["drone"]))


def _raise_event(app: App, options: Options, request: Mapping[str, object]) -> str:
    """Tell the running app that something has happened, or have its journal keep that."""
    try:
        return asked(app, options, request)
    except NotRunning:
        return record_event(app, options.the_journal, str(request["event"]), request)


def asked(app: App, options: Options, request: Mapping[str, object]) -> str:
    """Send a request to the running app, and return its answer."""
    journal = options.the_journal
    try:
        return ask(commands_note(journal), request, ANSWER_WITHIN)
    except NotRunning:
        if not journal.exists():
            raise missing(journal) from None
        raise NotRunning(
            f"{journal}: {app.name} is not running, so it cannot be told; "
            f"{app.name} resume {in_shell(journal)} goes on"
        ) from None
    except AnswerLost as error:
        raise AnswerLost(
            f"{journal}: {error}; {app.name} resume {in_shell(journal)} does that"
        ) from None
    except NoAnswer as error:
        raise NoAnswer(
            f"{journal}: {error}; a hook may keep it busy. "
            f"{app.name} tell {in_shell(journal)} stop brings the drones down all the same"
        ) from None


def _request(app: App, options: Options) -> dict[str, object]:
    """Return the request for a command line; raise `BadInput` if it is invalid."""
    action, mission, trip = options.action, options.mission, options.trip
    wrong = _wrong(options)
    if wrong:
        raise BadInput(f"{app.name} tell: {wrong}")
    match action:
        case "stop":
            return {"command": action, "how": (Down.HOME if options.rtl else Down.LAND).value}
        case "skip":
            return {"command": action, "mission": mission, "trip": trip}
        case "prioritise":
            given = {"mission": mission, "trip": trip, "priority": options.priority}
            return {"command": action, **given}
        case "retire" | "bring-back":
            return {"command": action, "drone": mission}
        case "mishap":
            return {"command": action, "drone": mission, "kind": options.kind}
        case "change-trips" if options.given is not None:
            trips = trips_in(options.given, str(mission))
            return {"command": action, "mission": mission, "trips": trips}
        case "join" if options.given is not None:
            return {**drone_in(options.given, str(mission)), "command": action, "drone": mission}
        case "event":
            facts = _facts((trip, *options.more))
            return {"command": "raise-event", "event": mission, "keep": options.keep, **facts}
        case _:
            return {"command": action, "mission": mission}


def _facts(given: Iterable[str | None]) -> dict[str, object]:
    """Return what is said of an event, as `at=3,4 level=0.7`; raise `BadInput` if that is nothing."""
    facts: dict[str, object] = {}
    fields: dict[str, object] = {}
    for one in filter(None, given):
        name, equals, text = one.partition("=")
        if not equals:
            raise BadInput(f"{quoted(one)} is no fact of an event: write it like level=0.7")
        if name == "at":
            facts[name] = _place(text)
        elif name in OF_AN_EVENT:
            facts[name] = text
        else:
            fields[name] = _value(text)
    return {**facts, "fields": fields}


def _place(text: str) -> list[float]:
    """Return a place that was typed as `3,4`, or `3,4,1.2`; raise `BadInput`."""
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise BadInput(f"at={text} is no place: write it in metres, like at=3,4") from None


def _value(text: str) -> object:
    """Return a number, a truth, or a text, such as a number with its unit."""
    truths = {"true": True, "false": False}
    if text in truths:
        return truths[text]
    with suppress(ValueError):
        return int(text)
    with suppress(ValueError):
        return float(text)
    return text


def _wrong(options: Options) -> str:
    """Return what is invalid in a command, or nothing."""
    action, mission, trip = options.action, options.mission, options.trip
    only = (
        ("--land and --rtl go", options.land or options.rtl, ("stop",)),
        ("--to goes", options.priority is not None, ("prioritise",)),
        ("--all goes", options.everyone, ("cut-motors",)),
        ("--from goes", options.given is not None, ("change-trips", "join")),
        ("--kind goes", options.kind is not None, ("mishap",)),
        ("--keep goes", options.keep is not None, ("event",)),
    )
    for flag, is_given, actions in only:
        if is_given and action not in actions:
            return f"{flag} with {' and '.join(actions)}, not with {action}"
    match action:
        case "stop" if mission is not None:
            return "stop brings all drones down; to end one mission, cancel it, or pause it"
        case "skip" if mission is None:
            return "skip needs the name of a mission"
        case "cut-motors" if (mission is None) is not options.everyone:
            return "cut-motors lets a drone fall: name the drone, or say --all"
        case "retire" | "bring-back" if mission is None:
            return f"{action} needs the name of a drone"
        case "change-trips" if mission is None or options.given is None:
            return (
                "change-trips needs a mission, and --from with a missions file that has its trips"
            )
        case "join" if mission is None or options.given is None:
            return "join needs the name of a drone, and --from with a fleet file that has it"
        case "mishap" if mission is None or options.kind is None:
            return f"mishap needs the name of a drone, and --kind: {', '.join(MISHAPS)}"
        case "prioritise" if mission is None or trip is None or options.priority is None:
            return "prioritise needs a mission, a trip of it, and --to N"
        case "event" if mission is None:
            return "event needs the name of an event"
        case _ if trip is not None and action not in ("skip", "prioritise", "event"):
            return f"{action} takes no trip; only skip and prioritise do"
    return ""


def _stop(app: App, options: Options, request: dict[str, object]) -> str:
    """Stop the app; if it does not answer, stop the drones by the gateway."""
    journal, how = Path(os.path.realpath(options.the_journal)), Down(request["how"])
    again = f"{app.name} resume {in_shell(journal)}"
    if gateway_folder(journal).is_dir():
        # If the app crashes meanwhile, its next process must land as well.
        offline.leave_stop(journal, how)
    until = time.monotonic() + ANSWER_WITHIN
    while True:
        try:
            return ask(commands_note(journal), request, STOP_DIRECTLY_AFTER)
        except (NotRunning, NoAnswer) as unheard:
            with suppress(NotRunning):
                said = stop_directly(gateway_folder(journal), how, ANSWER_WITHIN)
                return f"{unheard}: {said} without it; {again} goes on"
        if holder(journal) is None:
            if not journal.exists():
                raise missing(journal)
            raise NotRunning(f"{journal}: {app.name} is not running, and no drone flies")
        if time.monotonic() > until:
            raise NoAnswer(f"{journal}: {app.name} runs, but has come to no drones: end it")
        offline.leave_stop(journal, how)  # it has only just started, and must not fly
        time.sleep(0.1)


def cut_motors(app: App, journal: Path, drone: str | None) -> str:
    """Switch motors off directly by the gateway, so that the app cannot delay it."""
    journal = Path(os.path.realpath(journal))
    until = time.monotonic() + STOP_DIRECTLY_AFTER
    while True:
        try:
            return cut_directly(gateway_folder(journal), drone, ANSWER_WITHIN)
        except NotRunning:
            if time.monotonic() > until:
                break
        except NoAnswer:
            raise NoAnswer(
                f"{journal}: what commands the drones does not answer, so it is not known whether"
                " their motors are cut"
            ) from None
        time.sleep(0.05)  # it may have just died, and be restarting
    if not journal.exists():
        raise missing(journal)
    raise NotRunning(
        f"{journal}: nothing commands its drones, so no motor can be cut from here;"
        f" {app.name} resume {in_shell(journal)} reaches them again"
    )


def decide(app: App, options: Options) -> int:
    """Answer the question that a mission waits for, in the running app or in its journal."""
    journal, mission, answer = options.the_journal, options.mission, options.answer
    records = records_in(app, journal)
    if mission is None:
        listed = [*waiting_lines(app, journal, records)]
        for line in listed or ["no mission waits for a person"]:
            output.line(line)
        return 0
    # A wrong answer can be changed until it takes effect.
    questions = {name: (what, why) for name, what, why in waiting(records, answered=True)}
    if mission not in questions:
        raise BadInput(_not_asked(journal, mission, records))
    what, question = questions[mission]
    if answer not in ANSWERS[what]:
        fitting = ", ".join(ANSWERS[what])
        raise BadInput(
            f"{journal}: mission {quoted(mission)}: {printable(question)}; say one of: {fitting}"
        )
    try:
        request = {"command": "decide", "mission": mission, "answer": answer}
        output.line(asked(app, options, request))
    except NotRunning:
        record_decision(journal, mission, answer)
        output.line(
            f"mission {quoted(mission)}: {answer}; it is on record, and "
            f"{app.name} resume {in_shell(journal)} acts on it"
        )
    return 0


def _not_asked(journal: Path, mission: str, records: Standing) -> str:
    known = mission in records.missions
    what = "waits for no decision" if known else "is not in this journal"
    others = ", ".join(quoted(name) for name, _, _ in waiting(records))
    rest = f"; those that wait are: {others}" if others else ""
    return f"{journal}: mission {quoted(mission)} {what}{rest}"


def trips_in(file: Path, mission: str) -> object:
    """Return the trips of a mission of a missions file, as they are written there."""
    found = _table(file, "mission", "name", mission)
    for key in ("area", "each"):
        if key in found:
            raise BadInput(
                f"{file}: mission {quoted(mission)} has {key}: write plain trips"
                " (check --write makes them)"
            )
    return found.get("trip", [])


def drone_in(file: Path, id: str) -> Mapping[str, object]:
    """Return a drone of a fleet file, as it is written there."""
    return {key: one for key, one in _table(file, "drone", "id", id).items() if key != "id"}


def _table(file: Path, what: str, key: str, name: str) -> Mapping[str, object]:
    """Return the table with this name, as a command carries it; raise `BadInput` if there is none."""
    tables = list(_tables(read(file).data.get(what)))
    for table in tables:
        if table.get(key) == name:
            carried: Mapping[str, object] = json.loads(json.dumps(table, default=_written))
            return carried
    names = listed(quoted(str(one[key])) for one in tables if key in one)
    raise BadInput(f"{file}: there is no {what} {quoted(name)}; there are: {names}")


def _tables(given: object) -> Iterator[Mapping[str, object]]:
    for one in given if isinstance(given, list) else ():
        if isinstance(one, dict):
            yield one


def _written(value: object) -> str:
    """Write TOML's times and dates as the texts that may stand for them in a file."""
    return f"{value:%H:%M:%S}" if isinstance(value, time_of_day) else str(value)
