"""The handlers of flights of the past: each only reads, in a thread."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from math import isfinite

from ...shared.domain.errors import BadInput
from ..commands import Malformed
from .http import Reply, json_reply
from .http import said as in_words
from .served import Asked

THREADS = ThreadPoolExecutor(2, "flights")
"""Threads of its own: a Stop may need those of the loop, and never waits for what is read here."""

MCAP = "application/octet-stream"

_LONGEST_NUMBER = 24
"""Digits and signs of a time."""


async def flights(asked: Asked) -> Reply:
    """Answer with a line for each flight."""
    return await in_thread(lambda: json_reply(200, asked.station.past.flights()))


async def replay(asked: Asked) -> Reply:
    """Answer with a part of a flight's replay."""
    start = _seconds(asked)
    return await in_thread(lambda: json_reply(200, asked.station.past.replay(id_in(asked), start)))


async def report(asked: Asked) -> Reply:
    """Answer with what is to be said of a flight on paper."""
    return await in_thread(lambda: json_reply(200, asked.station.past.report(id_in(asked))))


async def mcap(asked: Asked) -> Reply:
    """Answer with a flight as an MCAP file."""

    def read() -> Reply:
        body = asked.station.past.mcap(id_in(asked))
        return download(Reply(status=200, body=body, type=MCAP), "flight.mcap")

    return await in_thread(read)


async def hours(asked: Asked) -> Reply:
    """Answer with what each drone has flown."""
    return await in_thread(lambda: json_reply(200, asked.station.past.hours()))


async def in_thread(read: Callable[[], Reply]) -> Reply:
    """Read of a flight of the past; 404 if there is none of the id that was asked for."""
    try:
        return await asyncio.get_running_loop().run_in_executor(THREADS, read)
    except BadInput as error:
        return in_words(404, str(error))


def id_in(asked: Asked) -> str:
    """Return the id of the flight that was asked for; empty: none."""
    return asked.request.query.get("flight", "")


def download(reply: Reply, name: str) -> Reply:
    """Return an answer that a browser saves as a file."""
    named = ("Content-Disposition", f'attachment; filename="{name}"')
    return Reply(status=reply.status, body=reply.body, type=reply.type, headers=(named,))


def _seconds(asked: Asked) -> float:
    text = asked.request.query.get("start") or "0"
    try:
        seconds = float(text) if len(text) <= _LONGEST_NUMBER and text.isascii() else -1.0
    except ValueError:
        seconds = -1.0
    if not (isfinite(seconds) and seconds >= 0):
        raise Malformed("start must be a number of seconds, from 0 on")
    return seconds
