"""The handlers of flights of the past: each only reads, apart from the station's process."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from math import isfinite
from typing import Concatenate, ParamSpec

from ...process.beside import Died
from ...shared.domain.errors import BadInput
from ..commands import Malformed
from ..flight_files import FlightFiles
from . import refusals
from .http import Reply, json_reply, said, text_reply
from .refusals import Refused
from .served import Asked

MCAP = "application/octet-stream"

P = ParamSpec("P")

_LONGEST_NUMBER = 24
"""Digits and signs of a time."""

_LONGEST_FLIGHT = 100


async def flights(asked: Asked) -> Reply:
    """Answer with a line for each flight."""
    return await _read(asked, _flights)


def _flights(files: FlightFiles) -> Reply:
    return json_reply(200, files.past.flights())


async def replay(asked: Asked) -> Reply:
    """Answer with a part of a flight's replay."""
    return await _read(asked, _replay, flight_in(asked), _seconds(asked))


def _replay(files: FlightFiles, id: str, start: float) -> Reply:
    return json_reply(200, files.past.replay(id, start))


async def report(asked: Asked) -> Reply:
    """Answer with what is to be said of a flight on paper."""
    return await _read(asked, _report, flight_in(asked))


def _report(files: FlightFiles, id: str) -> Reply:
    return json_reply(200, files.past.report(id))


async def mcap(asked: Asked) -> Reply:
    """Answer with a flight as an MCAP file."""
    return await _read(asked, _mcap, flight_in(asked))


def _mcap(files: FlightFiles, id: str) -> Reply:
    named = ("Content-Disposition", 'attachment; filename="flight.mcap"')
    return Reply(status=200, body=files.past.mcap(id), type=MCAP, headers=(named,))


async def hours(asked: Asked) -> Reply:
    """Answer with what each drone has flown."""
    return await _read(asked, _hours)


def _hours(files: FlightFiles) -> Reply:
    return json_reply(200, files.past.hours())


async def console(asked: Asked) -> Reply:
    """Answer with the console, that of the current flight if none is named."""
    if id := flight_in(asked):
        return await _read(asked, _console, id)
    return _console_reply(asked.station.console())


def _console(files: FlightFiles, id: str) -> Reply:
    return _console_reply(files.past.console(id))


def _console_reply(text: str) -> Reply:
    return text_reply(text, "console.txt")


async def _read(
    asked: Asked,
    question: Callable[Concatenate[FlightFiles, P], Reply],
    *given: P.args,
    **named: P.kwargs,
) -> Reply:
    """Read of a flight of the past."""
    return await or_404(asked.station.files.ask(question, *given, **named))


async def or_404(found: Awaitable[Reply]) -> Reply:
    """Return the answer; 404 if there is nothing of what was asked for."""
    try:
        return await found
    except BadInput as why:
        return said(404, str(why))
    except Died:
        raise Refused(refusals.READER_ENDED) from None


def flight_in(asked: Asked) -> str:
    """Return the id of the flight that was asked for; empty: none."""
    flight = asked.request.query.get("flight", "")
    if len(flight) > _LONGEST_FLIGHT:
        raise Malformed(f"flight is the id of a flight, of at most {_LONGEST_FLIGHT} characters")
    return flight


def _seconds(asked: Asked) -> float:
    text = asked.request.query.get("start") or "0"
    try:
        seconds = float(text) if len(text) <= _LONGEST_NUMBER and text.isascii() else -1.0
    except ValueError:
        seconds = -1.0
    if not (isfinite(seconds) and seconds >= 0):
        raise Malformed("start must be a number of seconds, from 0 on")
    return seconds
