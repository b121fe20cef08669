"""transitions: one AsyncMachine for all missions; the blocks are its states, callbacks do the work."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING

from transitions.extensions.asyncio import AsyncMachine

from . import ideal
from .futures import Fleet, launch
from .process import Notes, main
from .work import Done, Work

STATES = ["standby", "allocated", "flying", "failed", "completed", "evaluated", "end"]
TRANSITIONS: list[dict[str, str]] = [
    {"trigger": "allocate", "source": "standby", "dest": "allocated", "before": "take_drone"},
    {"trigger": "launch", "source": "allocated", "dest": "flying", "after": "fly"},
    {
        "trigger": "landed",
        "source": "flying",
        "dest": "failed",
        "unless": "is_ok",
        "before": "give_drone",
        "after": "count_failure",
    },
    {
        "trigger": "landed",
        "source": "flying",
        "dest": "standby",
        "conditions": "has_more",
        "before": "give_drone",
        "after": "count_trip",
    },
    {
        "trigger": "landed",
        "source": "flying",
        "dest": "completed",
        "before": "give_drone",
        "after": "count_trip",
    },
    {"trigger": "retry", "source": "failed", "dest": "standby", "before": "raise_priority"},
    {"trigger": "judge", "source": "completed", "dest": "evaluated"},
    {"trigger": "again", "source": "evaluated", "dest": "end"},
]


class Mission(ideal.Mission):
    """A mission, and what the machine calls."""

    if TYPE_CHECKING:  # the machine gives it these

        state: str

        async def allocate(self) -> bool: ...

        async def launch(self) -> bool: ...

        async def landed(self) -> bool: ...

        async def retry(self) -> bool: ...

        async def judge(self) -> bool: ...

        async def again(self) -> bool: ...

    def __init__(self, number: int, trips: int, fleet: Fleet) -> None:
        super().__init__(number, trips)
        self.fleet, self.ok = fleet, False
        self.flight: asyncio.Future[bool]

    async def take_drone(self) -> None:
        """Wait for a drone."""
        self.drone = await self.fleet.acquire(self.priority)

    async def fly(self) -> None:
        """Launch it."""
        self.flight = launch(self.id, self.trip, self.attempt)

    def is_ok(self) -> bool:
        """Return whether the flight went well."""
        return self.ok

    def has_more(self) -> bool:
        """Return whether another trip is to be flown."""
        return self.trip + 1 < self.trips

    async def give_drone(self) -> None:
        """Give the drone back."""
        self.fleet.release(self.drone)
        self.drone = -1

    async def count_failure(self) -> None:
        """A flight has failed."""
        self.failed_trips += 1

    async def count_trip(self) -> None:
        """A trip is done."""
        self.done_trips += 1
        self.trip += 1
        self.attempt = 0

    async def raise_priority(self) -> None:
        """Try it once more."""
        self.priority += 1
        self.attempt += 1

    async def live(self) -> None:
        """Take the mission from start to end."""
        while True:
            await self.allocate()
            await self.launch()
            self.ok = await self.flight
            await self.landed()
            if self.state == "failed":
                await self.retry()
            elif self.state == "completed":
                await self.judge()
                await self.again()
                self.status = ideal.COMPLETED
                return


async def all_flows(work: Work) -> Done:
    """Fly all missions side by side."""
    fleet = Fleet(work.drones)
    missions = [Mission(number, work.trips, fleet) for number in range(work.missions)]
    machine = AsyncMachine(
        model=None,
        states=STATES,
        transitions=TRANSITIONS,
        initial="standby",
        auto_transitions=False,
        send_event=False,
    )
    machine.add_model(missions)
    await asyncio.gather(*(m.live() for m in missions))
    return ideal.told([*missions])


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    return asyncio.run(all_flows(work))


if __name__ == "__main__":
    logging.getLogger("transitions").setLevel(logging.ERROR)
    main(fly)
