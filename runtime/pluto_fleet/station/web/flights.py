"""The addresses of the flights of the past: each only reads, in a thread."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from math import isfinite
from typing import Protocol

from ...shared.domain.errors import BadInput
from ..commands import Malformed
from .http import Reply, json_reply, text_reply
from .http import said as in_words

FLIGHTS = "/api/flights"
ADDRESSES: Mapping[str, tuple[str, ...]] = {
    FLIGHTS: ("GET",),
    "/api/flights/replay": ("GET",),
    "/api/flights/report": ("GET",),
    "/api/flights/mcap": ("GET",),
    "/api/drones/hours": ("GET",),
}

ALSO = ("/api/console.txt", "/api/results.json")
"""Addresses of the flight of now, and with `flight` of one of the past."""

THREADS = ThreadPoolExecutor(2, "flights")
"""Threads of its own: a Stop may need those of the loop, and never waits for what is read here."""

_LONGEST_NUMBER = 24
"""Digits and signs of a time."""


class ServedFlights(Protocol):
    """The flights of the past; what names one raises `BadInput` if there is none of this id."""

    def flights(self) -> object:
        """Return a line for each flight."""

    def hours(self) -> object:
        """Return what each drone has flown."""

    def replay(self, id: str, start: float, /) -> object:
        """Return a part of a flight's replay."""

    def report(self, id: str, /) -> object:
        """Return what is to be said of a flight on paper."""

    def mcap(self, id: str, /) -> bytes:
        """Return a flight as an MCAP file."""

    def console(self, id: str, /) -> str:
        """Return the console of a flight."""

    def results(self, id: str, /) -> object:
        """Return the results of a flight."""


def is_of_flights(path: str, query: Mapping[str, str]) -> bool:
    """Whether a request is about flights of the past."""
    return path in ADDRESSES or (path in ALSO and "flight" in query)


async def read_flights(flights: ServedFlights, path: str, query: Mapping[str, str]) -> Reply:
    """Handle a request about flights of the past."""
    start = _seconds(query) if path == "/api/flights/replay" else 0.0
    try:
        id, loop = query.get("flight", ""), asyncio.get_running_loop()
        return await loop.run_in_executor(THREADS, _read, flights, path, id, start)
    except BadInput as error:
        return in_words(404, str(error))


def _read(flights: ServedFlights, path: str, id: str, start: float) -> Reply:
    match path:
        case "/api/flights":
            return json_reply(200, flights.flights())
        case "/api/drones/hours":
            return json_reply(200, flights.hours())
        case "/api/flights/replay":
            return json_reply(200, flights.replay(id, start))
        case "/api/flights/report":
            return json_reply(200, flights.report(id))
        case "/api/console.txt":
            return text_reply(flights.console(id), "console.txt")
        case "/api/results.json":
            return _download(json_reply(200, flights.results(id)), "results.json")
        case _:
            body = flights.mcap(id)
            return _download(
                Reply(status=200, body=body, type="application/octet-stream"), "flight.mcap"
            )


def _download(reply: Reply, name: str) -> Reply:
    named = ("Content-Disposition", f'attachment; filename="{name}"')
    return Reply(status=reply.status, body=reply.body, type=reply.type, headers=(named,))


def _seconds(query: Mapping[str, str]) -> float:
    text = query.get("from", "0")
    try:
        seconds = float(text) if len(text) <= _LONGEST_NUMBER and text.isascii() else -1.0
    except ValueError:
        seconds = -1.0
    if not (isfinite(seconds) and seconds >= 0):
        raise Malformed("from must be a number of seconds, from 0 on")
    return seconds
