"""Keeping pages up to date: each sends the version that it has, and gets what is newer."""

from __future__ import annotations

import asyncio
import json
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

import msgspec
from starlette.responses import Response
from starlette.websockets import WebSocket, WebSocketDisconnect

from ...shared.domain.text import cut_off, printable
from ..operation import JSON, in_words
from ..wire import LiveRequest, Me, Person, Role
from . import refusals
from .audit import LONGEST_WHO, Audit
from .guard import Guard, Rate, client_of, role_by
from .handlers import Asked
from .refusals import Refused

if TYPE_CHECKING:
    from ..station import Station


def shortened(me: Me) -> Me:
    """Return what a page says of itself, sanitized."""
    return {
        "id": _short(me["id"], 32),
        "name": _short(me["name"], LONGEST_WHO),
        "page": _short(me["page"], 40),
        "touches": _short(me["touches"], 64),
    }


def _short(text: str, most: int) -> str:
    return cut_off(printable(text.strip()), most)


class People:
    """The browsers that are connected."""

    def __init__(self) -> None:
        self._here: dict[object, Person] = {}
        self.version = 0

    def enter(self, page: object, role: Role, me: Me) -> None:
        """Note what a connected page says of itself."""
        person: Person = {**me, "role": role}
        if self._here.get(page) != person:
            self._here[page] = person
            self.version += 1

    def leave(self, page: object) -> None:
        """Forget a page, as its connection has ended."""
        if self._here.pop(page, None) is not None:
            self.version += 1

    def others(self, page: object) -> list[Person]:
        """Return all but the person at a page, each once, as their latest page says."""
        own = self._here.get(page)
        found = {person["id"]: person for person in self._here.values()}
        if own is not None:
            found.pop(own["id"], None)
        return list(found.values())


class Displaced(Exception):
    """Raised in a connection whose place another has taken."""


class WaitingPlaces:
    """So many places; where all are taken, one more takes the oldest of the client that has most of them."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._waiting: dict[asyncio.Task[None], str] = {}
        """The client of each connection, the oldest first."""

    @contextmanager
    def taken(self, task: asyncio.Task[None], client: str) -> Iterator[None]:
        """Keep a place for a connection, whose task raises `Displaced` if another takes it."""
        if len(self._waiting) >= self._most:
            self._make_room()
        self._waiting[task] = client
        try:
            yield
        except asyncio.CancelledError:
            if task in self._waiting:  # the whole station ends
                raise
            task.uncancel()
            raise Displaced from None
        finally:
            self._waiting.pop(task, None)

    def _make_room(self) -> None:
        [(greedy, _)] = Counter(self._waiting.values()).most_common(1)
        oldest = next(task for task, client in self._waiting.items() if client == greedy)
        del self._waiting[oldest]
        oldest.cancel()


LIVE = "/api/live"

_MOST_PAGES = 32
"""The most connected pages of those who may command, and as many of those who watch."""
_MOST_WAITING = 32
"""The most connections that have not sent anything yet."""
_MESSAGES_A_SECOND = 20.0
"""The most messages per second from a page."""
_FIRST_WITHIN, _NEXT_WITHIN = 10.0, 120.0
"""Time-outs of the first message and of the next ones, in seconds."""
_LONGEST_REASON = 120
"""The longest reason in a close frame, in bytes."""

NO_TOKEN, MALFORMED, TOO_MANY, TROUBLE, SILENT, OVER = 4401, 4400, 4429, 1011, 4408, 1012
"""Close codes; from 4400 on HTTP's status plus 4000."""

_DECODER = msgspec.json.Decoder(LiveRequest)


class LiveUpdates:
    """The connections of all pages."""

    def __init__(
        self, station: Station, guard: Guard, audit: Audit, clock: Callable[[], float]
    ) -> None:
        self._station = station
        self._guard = guard
        self._audit = audit
        self._clock = clock
        self._on: Counter[Role] = Counter()
        self._places = WaitingPlaces(_MOST_WAITING)
        self._people = People()
        self._talks: set[asyncio.Task[None]] = set()
        self._over = False

    async def poll(self, asked: Asked, flight: str, seen: int, log: int, results: int) -> Response:
        """Answer a page that polls, without a WebSocket."""
        if self._on[asked.role] >= _MOST_PAGES:
            raise Refused(refusals.TOO_BUSY)
        self._on[asked.role] += 1
        try:
            text = await self._station.newer(flight, seen, log, results)
        finally:
            self._on[asked.role] -= 1
        return Response(text.encode("utf-8", "replace"), media_type=JSON)

    async def talk(self, page: WebSocket) -> None:
        """Serve a page's WebSocket until it closes."""
        task = asyncio.current_task()
        assert task is not None
        if self._over:
            await page.close()
            return
        self._talks.add(task)
        try:
            await self._converse(page, task)
        except (WebSocketDisconnect, OSError):
            pass  # the page has gone away
        except _Improper as error:
            self._audit.refused(page, error.code - 4000, str(error))
            await _hang_up(page, error.code, str(error))
        except asyncio.CancelledError:
            if not self._over:
                raise
            await _hang_up(page, OVER, "the station ends")
        except Exception as error:  # noqa: BLE001 - a bug ends the talk with one page alone
            self._audit.trouble(page, error)
            await _hang_up(page, TROUBLE, "something went wrong inside the station")
        finally:
            self._talks.discard(task)

    def end(self) -> None:
        """Close the connections of all pages."""
        self._over = True
        for task in self._talks:
            task.cancel()

    async def _converse(self, page: WebSocket, task: asyncio.Task[None]) -> None:
        try:
            with self._places.taken(task, client_of(page)):
                await page.accept()
                first = await _heard(page, _FIRST_WITHIN)
        except Displaced:
            raise _Improper(TOO_MANY, refusals.TOO_BUSY.said) from None
        role = role_by(self._guard, first.get("token", ""))
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

    async def _tell(self, page: WebSocket, asked: LiveRequest, role: Role) -> None:
        rate = Rate(_MESSAGES_A_SECOND, self._clock)
        told = 0
        while True:
            if not rate.allows(""):
                raise _Improper(TOO_MANY, refusals.TOO_MANY.said)
            if "me" in asked:
                self._people.enter(page, role, shortened(asked["me"]))
            text = await self._station.newer(
                asked["flight"], asked["seen"], asked["log"], asked["results"]
            )
            if told != self._people.version:
                told = self._people.version
                text = f'{text[:-1]}, "people": {json.dumps(self._people.others(page))}}}'
            await page.send_text(text)
            asked = await _heard(page, _NEXT_WITHIN)


class _Improper(Exception):
    """Raised to close a page's connection, with the reason."""

    def __init__(self, code: int, why: str) -> None:
        super().__init__(why)
        self.code = code


async def _heard(page: WebSocket, within: float) -> LiveRequest:
    """Return the next message, if it comes in time and is valid."""
    try:
        async with asyncio.timeout(within):
            message = await page.receive()
    except TimeoutError:
        raise _Improper(SILENT, f"nothing was said for {within:g} seconds") from None
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code", 1005))
    try:
        return _DECODER.decode(message.get("text") or "")
    except msgspec.ValidationError as error:
        raise _Improper(MALFORMED, in_words(str(error), LiveRequest.__annotations__)) from None
    except (msgspec.DecodeError, RecursionError) as error:
        raise _Improper(MALFORMED, f"what was sent is not JSON: {error}") from None


async def _hang_up(page: WebSocket, code: int, why: str) -> None:
    reason = why.encode()[:_LONGEST_REASON].decode(errors="ignore")
    with suppress(WebSocketDisconnect, RuntimeError, OSError):  # it may have gone away
        await page.close(code, reason)
