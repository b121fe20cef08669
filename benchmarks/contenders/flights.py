"""What drives our own package: no drone moves, and every flight is reported.

Each takes the brain's orders, looks into a flight's id for the numbers of mission, trip and attempt, and
tells the brain what came of it.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from math import inf
from typing import TYPE_CHECKING, Any

from .process import Notes, kernel_says
from .work import Work, fails

if TYPE_CHECKING:
    from pluto_fleet.shared.brain import Brain
    from pluto_fleet.shared.domain.trace import Event

HOME = (1.0, 1.0, 0.0)
"""Where all drones stand."""

Order = Mapping[str, Any]
Message = dict[str, Any]
Hear = Callable[["Event"], object] | None
"""Called with every transition; None: no listener."""


class Flights:
    """What all of them have in common: drones that stand where they shall be."""

    def __init__(self, hear: Hear) -> None:
        self.brain: Brain
        """To be set before anything begins."""
        self.hear = hear

    def begin(self, missions: Sequence[Mapping[str, Any]], drones: int, now: float) -> None:
        """Let missions begin, and say that all drones are charged."""
        full = {str(number): {"battery": 1.0} for number in range(drones)}
        self.brain.tell({"telemetry": full}, now)
        self.brain.begin(missions, now)

    def obey(self, order: Order) -> None:
        """Fly; a drone that shall be recovered stands at home already."""
        if order["do"] == "fly":
            self.fly(order)
        else:
            self.answer({"done": order["id"], "value": True})

    def fly(self, order: Order) -> None:
        """Fly, then tell."""
        raise NotImplementedError

    def answer(self, message: Message) -> None:
        """Tell something, and never from within this call."""
        raise NotImplementedError

    def listen(self) -> None:
        """Pass on what has happened."""
        if self.hear is not None:
            for event in self.brain.events():
                self.hear(event)


number = lru_cache(maxsize=1_000)(int)
"""Reading a number takes as long as all else here."""


def outcome(order: Order) -> Message:
    """Return what is told of a flight."""
    mission, trip, _, attempt = order["flight"].split("/")
    if fails(number(mission), number(trip), number(attempt) - 1):
        return {"failed": order["id"], "failure": "CRASH", "reason": "the hash says so"}
    return {"done": order["id"]}


class ThroughTheKernel(Flights):
    """Tells in virtual time: at this instant, one after the other."""

    def __init__(self, hear: Hear) -> None:
        super().__init__(hear)
        self.told: list[Message] = []

    def fly(self, order: Order) -> None:
        """Fly, then tell."""
        self.told.append(outcome(order))

    def answer(self, message: Message) -> None:
        """Tell something when its turn comes."""
        self.told.append(message)

    def run(self, missions: Sequence[Mapping[str, Any]], drones: int) -> None:
        """Fly until everything has ended."""
        brain, now = self.brain, 0.0
        self.begin(missions, drones, now)
        while brain.over is None:
            for order in brain.orders():
                self.obey(order)
            told, self.told = self.told, []
            for message in told:
                brain.tell(message, now)
            if not told:
                due = brain.due
                if due is None:
                    raise SystemExit("nothing will ever happen again")
                now = due
                brain.advance(now)
            self.listen()


class FromTheLoop(Flights):
    """Tells from asyncio's loop, at once or after a while."""

    def __init__(self, hear: Hear, work: Work, notes: Notes) -> None:
        super().__init__(hear)
        self.loop, self.flight, self.notes = asyncio.get_running_loop(), work.flight, notes
        self.start = self.loop.time()
        self.armed: asyncio.TimerHandle | None = None
        self.armed_for = inf
        self.going_on = False
        """It goes on once all is told that the loop has at this turn."""
        self.ended: asyncio.Future[None] = self.loop.create_future()

    def time(self) -> float:
        """Return the seconds since the start, for hooks as well."""
        return self.loop.time() - self.start

    def post(self, call: Callable[..., object], *args: object) -> None:
        """Call what a hook wants to be called, and go on."""
        call(*args)
        self.go_on()

    async def run(self, missions: Sequence[Mapping[str, Any]], drones: int) -> None:
        """Fly until everything has ended."""
        self.begin(missions, drones, self.time())
        self.go_on()
        await self.ended

    def fly(self, order: Order) -> None:
        """Fly, then tell."""
        if self.flight:
            self.notes.launched(order["drone"], self.loop.time())
            self.loop.call_later(self.flight, self.land, order["drone"], outcome(order))
        else:
            self.loop.call_soon(self.tell, outcome(order))

    def land(self, drone: str, message: Message) -> None:
        """A flight that took time is over."""
        now = self.loop.time()
        self.notes.landed(drone, now)
        self.brain.tell(message, now - self.start)
        self.go_on()

    def answer(self, message: Message) -> None:
        """Tell something at the loop's next turn."""
        self.loop.call_soon(self.tell, message)

    def tell(self, message: Message) -> None:
        """Tell the brain what has happened."""
        self.brain.tell(message, self.time())
        if not self.going_on:
            self.going_on = True
            self.loop.call_soon(self.go_on)

    def go_on(self) -> None:
        """Let happen what is due, and do what the brain says."""
        self.going_on, brain = False, self.brain
        due = now = self.time()
        while due <= now:
            brain.advance(now)
            for order in brain.orders():
                self.obey(order)
            then = brain.due
            due = inf if then is None else then
        self.listen()
        if due < self.armed_for:
            if self.armed is not None:
                self.armed.cancel()
            self.armed_for = due
            self.armed = self.loop.call_at(self.start + due, self.due)
        if brain.over is not None and not self.ended.done():
            self.ended.set_result(None)

    def due(self) -> None:
        """Called when something is due."""
        self.armed, self.armed_for = None, inf
        self.go_on()


class AllTogether(FromTheLoop):
    """Tells once every mission that is not over is in the air, then of all of them."""

    def __init__(self, hear: Hear, work: Work, notes: Notes) -> None:
        super().__init__(hear, work, notes)
        self.left, self.last = work.missions, str(work.trips - 1)
        self.flying = self.ending = 0
        self.up: deque[Message] = deque()

    def fly(self, order: Order) -> None:
        """Wait for the others."""
        message = outcome(order)
        self.up.append(message)
        self.flying += 1
        self.ending += "done" in message and order["flight"].split("/")[1] == self.last
        if self.flying == self.left:
            self.loop.call_soon(self.come_down, self.flying)
            self.left -= self.ending
            self.flying = self.ending = 0

    def come_down(self, count: int) -> None:
        """All come down, while those that were first take off again."""
        self.notes.threads = max(self.notes.threads, kernel_says("Threads"))
        for _ in range(count):
            self.tell(self.up.popleft())
