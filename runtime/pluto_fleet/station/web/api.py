"""The HTTP interface of a station: access, rate limits, and the way to each address's handler."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import replace

from ..commands import Malformed
from ..sign import Logo
from ..wire import Role
from . import refusals
from .addresses import ADDRESSES, JSON, SMALL_BODY, Address
from .audit import Audit
from .guard import Access, Guard, Rate, refusal, role_of, with_safe_headers
from .http import MISTAKES, PageSocket, Reply, Request
from .live import LiveUpdates
from .refusals import Refusal, Refused
from .served import Asked, ServedStation
from .static import StaticFile, file_reply, logo_file, pages, picture
from .strict_json import parsed_object

_COMMANDS_A_SECOND, _EDITS_A_SECOND, _READS_A_SECOND = 20.0, 20.0, 100.0
"""Rates per second for each client; edits of the plan do not count as commands."""
_MOST_UNDER_WAY = 64
"""The most concurrent requests, without Stops."""
_MOST_READING = 32
"""The most of them that read files of flights: these may be slow, and leave room for all others."""
_MOST_LARGE = 2
"""The most of them whose bodies may be large."""
_WRONG_TOKEN_WAITS = 0.5
"""Seconds after which a wrong token is refused."""
_MOST_WAITING = 32
"""The most delayed refusals; more are sent at once."""

Pause = Callable[[float], Awaitable[object]]


class Api:
    """The HTTP interface of one station."""

    def __init__(
        self,
        station: ServedStation,
        guard: Guard,
        audit: Audit,
        *,
        clock: Callable[[], float] = time.monotonic,
        pause: Pause = asyncio.sleep,
        addresses: Sequence[Address] = ADDRESSES,
        logo: Logo | None = None,
    ) -> None:
        self.guard = guard
        self._station, self._audit, self._pause = station, audit, pause
        self._addresses: dict[str, dict[str, Address]] = {}
        for address in addresses:
            self._addresses.setdefault(address.path, {})[address.method] = address
        self._pages = pages()
        self._picture = picture(station.image)
        self._logo = logo_file(logo)
        self._commands, self._edits = Rate(_COMMANDS_A_SECOND, clock), Rate(_EDITS_A_SECOND, clock)
        self._reads = Rate(_READS_A_SECOND, clock)
        self._live = LiveUpdates(station, guard, audit, clock)
        self._under_way = self._reading = self._large = self._waiting = 0

    async def answer(self, request: Request) -> Reply:
        """Handle any request; errors reveal no internals."""
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
            reply = refusals.OURS.reply
        return with_safe_headers(request, reply)

    async def live(self, page: PageSocket, request: Request) -> None:
        """Serve a page's WebSocket."""
        await self._live.talk(page, request)

    def end(self) -> None:
        """Close the connections of all pages."""
        self._live.end()

    def _refused(self, request: Request, why: Refusal) -> Reply:
        self._audit.refused(request, why.status, why.said)
        return why.reply

    async def _answer(self, request: Request) -> Reply:
        access = _asking(request)
        why = refusal(self.guard, request, access)
        if why is not None:
            if why.status == 401:
                await self._slow_down()
            raise Refused(why)
        if access is Access.PAGE and request.path in self._pages:
            return file_reply(self._pages[request.path], request)
        if request.path == "/logo" and self._logo is not None and access is Access.PAGE:
            return file_reply(self._logo, request)
        if request.path == "/map" and (held := self._floor_plan()) is not None:
            return file_reply(held, request)
        address = self._route(request)
        role = role_of(self.guard, request)
        assert role is not None  # else it was refused
        if address.role == "fly" and role != "fly":
            raise Refused(refusals.WATCHES)
        if address.do is None:
            return await self._live.poll(request, role)
        if address.always:
            return await self._done(address, request, role)
        return await self._within_limits(address, request, role)

    def _route(self, request: Request) -> Address:
        """Return the address that is asked; raise `Refused` if there is none."""
        methods = self._addresses.get(request.path)
        if methods is None:
            raise Refused(refusals.NO_SUCH_PAGE)
        if request.method not in methods:
            raise Refused(refusals.wrong_method(", ".join(methods)))
        return methods[request.method]

    def _floor_plan(self) -> StaticFile | None:
        """Return the floor plan, read once: another one has another name."""
        if self._picture[0] != self._station.image:
            self._picture = picture(self._station.image)
        return self._picture[1]

    async def _within_limits(self, address: Address, request: Request, role: Role) -> Reply:
        """Handle a request within the limits."""
        if not self._rate(request).allows(f"{role} {request.client}"):
            raise Refused(refusals.TOO_MANY)
        reads, is_large = address.reads_flights, address.most_bytes > SMALL_BODY
        if (
            self._under_way >= _MOST_UNDER_WAY
            or (reads and self._reading >= _MOST_READING)
            or (is_large and self._large >= _MOST_LARGE)
        ):
            raise Refused(refusals.TOO_BUSY)
        self._under_way += 1
        self._reading += reads
        self._large += is_large
        try:
            return await self._done(address, request, role)
        finally:
            self._under_way -= 1
            self._reading -= reads
            self._large -= is_large

    async def _done(self, address: Address, request: Request, role: Role) -> Reply:
        """Read a request's body, and hand it to its handler."""
        assert address.do is not None
        body, given = b"", dict[str, object]()
        if address.body is not None:
            sent = request.headers.get("content-type", "").partition(";")[0].strip().lower()
            if sent not in address.media:
                raise Refused(refusals.wrong_type(" or ".join(address.media)))
            body = await request.read(address.most_bytes)
            if sent == JSON:
                given = parsed_object(body)
        return await address.do(
            Asked(
                station=self._station,
                audit=self._audit,
                request=request,
                role=role,
                given=given,
                body=body,
            )
        )

    def _rate(self, request: Request) -> Rate:
        if request.method == "GET":
            return self._reads
        return self._edits if request.path.startswith("/api/plan") else self._commands

    async def _slow_down(self) -> None:
        """Delay the refusal of a wrong token, against guessing."""
        if self._waiting >= _MOST_WAITING:
            return
        self._waiting += 1
        try:
            await self._pause(_WRONG_TOKEN_WAITS)
        finally:
            self._waiting -= 1


def _asking(request: Request) -> Access:
    if request.method != "GET":
        return Access.COMMAND
    reads = request.path.startswith("/api/") or request.path == "/map"
    return Access.READ if reads else Access.PAGE
