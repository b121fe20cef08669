"""Keeps a drone linked: connects to it, and again whenever its link was lost, for as long as it takes."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from math import inf
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.domain.text import duration, place

if TYPE_CHECKING:
    from .vehicle import Member

CONNECT = 15.0
"""Seconds for which others wait for a drone to be connected."""
ATTEMPT = 60.0
"""Seconds that an attempt may take, waited for or not: the first over a busy radio is slow."""
PAUSES = (1.0, 2.0, 4.0, 5.0)
"""Seconds between attempts; the last for as long as it may fly, or somebody waits for it."""
RARELY = 30.0
"""Seconds between attempts for one that stands on the ground: others need the radio."""
FRESH = 1.0
"""Seconds within which a drone that is said to be connected must have told where it is."""


class Linking:
    """The link to one drone."""

    def __init__(self, member: Member) -> None:
        self._member = member
        self._wanted, self._tried = asyncio.Event(), asyncio.Event()
        self._was_linked = self._given_up = False
        self._waiting = 0
        """How many wait for it."""
        self._task: asyncio.Task[None] | None = None
        member.on_lost = self._wanted.set

    def start(self) -> asyncio.Task[None]:
        """Connect, from now on, for as long as this task runs."""
        self._task = asyncio.ensure_future(self._keep())
        return self._task

    def stop(self) -> None:
        """Do not try any more."""
        if self._task is not None:
            self._task.cancel()

    async def once(self) -> bool:
        """Say whether it is linked; if it is not, after one more attempt."""
        member = self._member
        if not member.linked:
            self._wanted.set()
            try:
                async with asyncio.timeout(CONNECT):
                    await self._tried.wait()
            except TimeoutError:
                member.out_of_reach = f"{member.id} did not answer in {duration(CONNECT)}"
        return member.linked

    async def within(self, limit: float) -> bool:
        """Wait until it is linked, and say whether it is; after that nobody waits any longer."""
        self._given_up = False
        self._wanted.set()
        self._waiting += 1
        try:
            async with asyncio.timeout(limit):
                while not self._member.linked:
                    await self._tried.wait()
        except TimeoutError:
            self._given_up = True
        finally:
            self._waiting -= 1
        return self._member.linked

    async def _keep(self) -> None:
        attempts = 0
        while True:
            self._wanted.clear()
            pause: float | None = None
            if not self._member.linked:
                await self._attempt()
                tried, self._tried = self._tried, asyncio.Event()
                tried.set()
                attempts += 1
                pause = self._pause(attempts)
            if self._member.linked:
                attempts, pause = 0, None
            with suppress(TimeoutError):
                async with asyncio.timeout(pause):
                    await self._wanted.wait()

    def _pause(self, attempts: int) -> float:
        """Return for how long to wait after so many attempts."""
        if attempts > len(PAUSES) and self._member.seen.landed and not self._waiting:
            return RARELY
        return PAUSES[min(attempts, len(PAUSES)) - 1]

    async def _attempt(self) -> None:
        member, seen = self._member, self._member.seen
        flew = not seen.landed
        await member.calls.parted()
        try:
            await member.calls.call("answer", ATTEMPT, member.navigation.connect)
        except FlightFailed as error:
            self._fails(str(error))
            return
        if seen.silence > FRESH:
            self._fails(f"{member.id} is connected, but does not tell where it is")
            return
        member.linked, seen.rises_until = True, -inf
        if self._was_linked:
            self._is_back(flew)
        self._was_linked, self._given_up = True, False

    def _fails(self, why: str) -> None:
        if why != self._member.out_of_reach:
            self._member.out_of_reach = why
            self._member.calls.say(why)

    def _is_back(self, flew: bool) -> None:
        """It was lost meanwhile: it hovers on, or somebody has switched it off and on."""
        member, seen = self._member, self._member.seen
        where = place(seen.location)
        if seen.landed:
            member.boot += flew
            member.calls.say(f"{member.id} is back: it stands at {where}")
            return
        member.calls.say(f"{member.id} is back: it hovers at {where}")
        if self._given_up:
            late = f"{member.id} was out of reach for too long: it lands at {where}"
            member.must_come_down(FlightFailed(Failure.LINK, late), needs_a_hand=False)
