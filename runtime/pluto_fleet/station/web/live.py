"""Keeping pages up to date: each sends the version that it has, and gets what is newer.

So a page that stops reading costs nothing, and gets the newest state when it comes back.
"""

from __future__ import annotations

import asyncio
import json
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from typing import Protocol

from ..commands import Malformed
from ..wire import Me, Role
from . import refusals
from .audit import Audit
from .guard import Access, Guard, Rate, refusal, role_by
from .http import MISTAKES, Closed, PageSocket, Reply, Request
from .people import People, me_of
from .places import Displaced, WaitingPlaces
from .refusals import Refused
from .strict_json import asked_number, parsed_object

LIVE = "/api/live"
"""The address for WebSockets."""

_MOST_PAGES = 32
"""The most connected pages of those who may command, and as many of those who watch."""
_MOST_WAITING = 32
"""The most connections that have not sent anything yet."""
_MESSAGES_A_SECOND = 20.0
"""The most messages per second from a page."""
_FIRST_WITHIN, _NEXT_WITHIN = 10.0, 120.0
"""Time-outs of the first message and of the next ones, in seconds."""
_LONGEST_FLIGHT = 100

NO_TOKEN, MALFORMED, TOO_MANY, TROUBLE, SILENT, OVER = 4401, 4400, 4429, 1011, 4408, 1012
"""Close codes; from 4400 on HTTP's status plus 4000."""


class UpdateSource(Protocol):
    """The source of updates."""

    async def newer(self, flight: str, seen: int, log: int, results: int) -> str:
        """Return what is newer than a version, as JSON; wait briefly for it."""


class LiveUpdates:
    """The connections of all pages."""

    def __init__(
        self, station: UpdateSource, guard: Guard, audit: Audit, clock: Callable[[], float]
    ) -> None:
        self._station, self._guard, self._audit, self._clock = station, guard, audit, clock
        self._on: Counter[Role] = Counter()
        self._places = WaitingPlaces(_MOST_WAITING)
        self._people = People()
        self._talks: set[asyncio.Task[None]] = set()
        self._over = False

    async def poll(self, request: Request, role: Role) -> Reply:
        """Answer a page that polls, without a WebSocket."""
        query = request.query
        counts = [asked_number(query, name) for name in ("seen", "log", "results")]
        if self._on[role] >= _MOST_PAGES:
            raise Refused(refusals.TOO_BUSY)
        self._on[role] += 1
        try:
            text = await self._station.newer(query.get("flight", ""), *counts)
        finally:
            self._on[role] -= 1
        return Reply(status=200, body=text.encode("utf-8", "replace"))

    async def talk(self, page: PageSocket, request: Request) -> None:
        """Serve a page's WebSocket until it closes."""
        task = asyncio.current_task()
        assert task is not None
        self._talks.add(task)
        try:
            await self._admit(page, request, task)
        except Closed:
            pass
        except asyncio.CancelledError:
            if not self._over:
                raise
            await _hang_up(page, OVER, "the station ends")
        except MISTAKES as error:
            self._audit.trouble(request, error)
            await _hang_up(page, TROUBLE, "something went wrong inside the station")
        finally:
            self._talks.discard(task)

    def end(self) -> None:
        """Close the connections of all pages."""
        self._over = True
        for task in self._talks:
            task.cancel()

    async def _admit(self, page: PageSocket, request: Request, task: asyncio.Task[None]) -> None:
        """Accept a page after its first message, or close its connection with a reason."""
        why = refusal(self._guard, request, Access.LIVE)
        if why is None and request.path != LIVE:
            why = refusals.NO_SUCH_PAGE
        if why is None and self._over:
            why = refusals.TOO_BUSY
        if why is not None:
            self._audit.refused(request, why.status, why.said)
            await page.refuse()
            return
        try:
            await self._converse(page, request, task)
        except _Improper as error:
            self._audit.refused(request, error.code - 4000, str(error))
            await _hang_up(page, error.code, str(error))

    async def _converse(self, page: PageSocket, request: Request, task: asyncio.Task[None]) -> None:
        try:
            with self._places.taken(task, request.client):
                await page.open()
                first = await _heard(page, _FIRST_WITHIN)
        except Displaced:
            raise _Improper(TOO_MANY, refusals.TOO_BUSY.said) from None
        token = first.get("token", "")
        role = role_by(self._guard, token) if isinstance(token, str) else None
        if role is None:
            raise _Improper(NO_TOKEN, refusals.NO_TOKEN.said)
        if self._on[role] >= _MOST_PAGES:
            raise _Improper(TOO_MANY, refusals.TOO_BUSY.said)
        self._on[role] += 1
        try:
            await self._tell(page, first, role)
        finally:
            self._on[role] -= 1
            self._people.leave(page)

    async def _tell(self, page: PageSocket, asked: dict[str, object], role: Role) -> None:
        rate, told = Rate(_MESSAGES_A_SECOND, self._clock), 0
        while True:
            if not rate.allows(""):
                raise _Improper(TOO_MANY, refusals.TOO_MANY.said)
            seen, me = _seen(asked)
            if me is not None:
                self._people.enter(page, role, me)
            text = await self._station.newer(*seen)
            if told != self._people.version:
                told = self._people.version
                text = f'{text[:-1]}, "people": {json.dumps(self._people.others(page))}}}'
            await page.send(text)
            asked = await _heard(page, _NEXT_WITHIN)


class _Improper(Exception):
    """Raised to close a page's connection, with the reason."""

    def __init__(self, code: int, why: str) -> None:
        super().__init__(why)
        self.code = code


async def _heard(page: PageSocket, within: float) -> dict[str, object]:
    """Return the next message, if it comes in time and is valid."""
    try:
        async with asyncio.timeout(within):
            text = await page.receive()
    except TimeoutError:
        raise _Improper(SILENT, f"nothing was said for {within:g} seconds") from None
    try:
        return parsed_object(text)
    except Malformed as error:
        raise _Improper(MALFORMED, str(error)) from None


def _seen(asked: dict[str, object]) -> tuple[tuple[str, int, int, int], Me | None]:
    """Return the version that a page has, and what it says of itself."""
    match asked:
        case {"flight": str(flight), "seen": int(seen), "log": int(log), "results": int(results)}:
            try:
                return (flight[:_LONGEST_FLIGHT], seen, log, results), me_of(asked.get("me"))
            except Malformed as error:
                raise _Improper(MALFORMED, str(error)) from None
        case _:
            raise _Improper(MALFORMED, "a message says flight, seen, log and results")


async def _hang_up(page: PageSocket, code: int, why: str) -> None:
    with suppress(Closed):
        await page.close(code, why)
