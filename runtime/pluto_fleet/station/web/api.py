"""Everything that may be asked of a station goes through here: who may, how often, and what for."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable
from dataclasses import replace

from ..commands import Malformed
from . import refusals
from .answers import ADDRESSES, change, read
from .audit import Audit
from .behind import Station
from .dressing import dressed
from .guard import Asking, Guard, refusal
from .http import MISTAKES, Line, Reply, Request
from .live import LIVE, Live
from .rates import Rate
from .refusals import Refusal, Refused
from .static import handed_out, pages, picture

ALWAYS = ("/api/stop", "/api/cut-motors")
"""They bring drones down: whoever may command may always command these."""

_COMMANDS, _EDITS, _READS = 20.0, 20.0, 100.0
"""A second, for each client; whoever draws the plan has all commands left."""
_AT_ONCE = 64
"""Requests that are under way, Stops not counted."""
_WRONG_TOKEN = 0.5
"""Seconds that whoever lacks the token waits to be told so."""
_WAITING = 32
"""So many wait; more are told at once."""

Pause = Callable[[float], Awaitable[object]]


class Api:
    """All that can be asked of one station."""

    def __init__(
        self,
        station: Station,
        guard: Guard,
        audit: Audit,
        *,
        clock: Callable[[], float] = time.monotonic,
        pause: Pause = asyncio.sleep,
    ) -> None:
        self.guard = guard
        self._station, self._audit, self._pause = station, audit, pause
        self._pages = pages()
        self._picture = picture(station.image) if station.image is not None else None
        self._commands, self._edits = Rate(_COMMANDS, clock), Rate(_EDITS, clock)
        self._reads = Rate(_READS, clock)
        self._live = Live(station, guard, audit, clock)
        self._under_way = self._waiting = 0

    async def answer(self, request: Request) -> Reply:
        """Answer whatever is asked: no request breaks anything, and none is told how we are made."""
        if request.method == "HEAD":  # like GET; the server leaves the body out
            request = replace(request, method="GET")
        try:
            reply = await self._answer(request)
        except Refused as error:
            reply = self._refused(request, error.refusal)
        except Malformed as error:
            reply = self._refused(request, refusals.malformed(str(error)))
        except MISTAKES as error:
            self._audit.trouble(request, error)
            reply = refusals.ours().reply
        return dressed(request, reply)

    async def live(self, line: Line, request: Request) -> None:
        """Keep a page up to date for as long as it asks."""
        await self._live.talk(line, request)

    def end(self) -> None:
        """Hang up on everybody who is connected."""
        self._live.end()

    def _refused(self, request: Request, why: Refusal) -> Reply:
        self._audit.refused(request, why.status, why.said)
        return why.reply

    async def _answer(self, request: Request) -> Reply:
        asking = _asking(request)
        why = refusal(self.guard, request, asking)
        if why is not None:
            if why.status == 401:
                await self._slow_down()
            raise Refused(why)
        if asking is Asking.PAGE and request.path in self._pages:
            return handed_out(self._pages[request.path], request)
        if request.path == "/map" and self._picture is not None:
            return handed_out(self._picture, request)
        _route(request)
        if request.path == LIVE:
            return await self._live.poll(request)
        return await self._within_limits(request)

    async def _within_limits(self, request: Request) -> Reply:
        """Answer, unless too much is asked; what brings drones down never is."""
        if request.path in ALWAYS:
            return await change(self._station, self._audit, request)
        if not self._rate(request).allows(request.client):
            raise Refused(refusals.too_many())
        if self._under_way >= _AT_ONCE:
            raise Refused(refusals.too_busy())
        self._under_way += 1
        try:
            if request.method == "GET":
                return await read(self._station, request.path)
            return await change(self._station, self._audit, request)
        finally:
            self._under_way -= 1

    def _rate(self, request: Request) -> Rate:
        if request.method == "GET":
            return self._reads
        return self._edits if request.path.startswith("/api/plan") else self._commands

    async def _slow_down(self) -> None:
        """Let those who guess wait, and nobody else."""
        if self._waiting >= _WAITING:
            return
        self._waiting += 1
        try:
            await self._pause(_WRONG_TOKEN)
        finally:
            self._waiting -= 1


def _asking(request: Request) -> Asking:
    if request.method != "GET":
        return Asking.COMMAND
    reads = request.path.startswith("/api/") or request.path == "/map"
    return Asking.READ if reads else Asking.PAGE


def _route(request: Request) -> None:
    """Refuse what leads nowhere."""
    allowed = ADDRESSES.get(request.path)
    if allowed is None:
        raise Refused(refusals.no_such_page())
    if request.method not in allowed:
        raise Refused(refusals.wrong_method(", ".join(allowed)))
