"""python-statemachine, with its engine for asyncio: a state machine a mission."""

from __future__ import annotations

import asyncio

from statemachine import State, StateMachine

from . import ideal
from .futures import Fleet, launch
from .process import Notes, main
from .work import Done, Work


class Flow(StateMachine):
    """The graph of one mission."""

    standby = State(initial=True)
    allocated = State()
    flying = State()
    failed = State()
    completed = State()
    evaluated = State()
    end = State(final=True)
    allocate = standby.to(allocated)
    launch = allocated.to(flying)
    landed = (
        flying.to(failed, unless="is_ok")
        | flying.to(standby, cond="has_more")
        | flying.to(completed)
    )
    retry = failed.to(standby)
    judge = completed.to(evaluated)
    again = evaluated.to(end)

    def __init__(self, m: ideal.Mission, fleet: Fleet) -> None:
        self.m, self.fleet, self.ok = m, fleet, False
        self.flight: asyncio.Future[bool]
        super().__init__()

    async def before_allocate(self) -> None:
        """Wait for a drone."""
        self.m.drone = await self.fleet.acquire(self.m.priority)

    async def after_launch(self) -> None:
        """Launch it."""
        self.flight = launch(self.m.id, self.m.trip, self.m.attempt)

    def is_ok(self) -> bool:
        """Return whether the flight went well."""
        return self.ok

    def has_more(self) -> bool:
        """Return whether another trip is to be flown."""
        return self.m.trip + 1 < self.m.trips

    async def after_landed(self) -> None:
        """Give the drone back, and count."""
        m = self.m
        self.fleet.release(m.drone)
        m.drone = -1
        if self.ok:
            m.done_trips += 1
            m.trip += 1
            m.attempt = 0
        else:
            m.failed_trips += 1

    async def before_retry(self) -> None:
        """Try it once more."""
        self.m.priority += 1
        self.m.attempt += 1


async def live(m: ideal.Mission, fleet: Fleet) -> None:
    """Take a mission from start to end."""
    machine = Flow(m, fleet)
    await machine.activate_initial_state()
    while True:
        await machine.allocate()
        await machine.launch()
        machine.ok = await machine.flight
        await machine.landed()
        if not machine.ok:
            await machine.retry()
        elif m.trip == m.trips:
            await machine.judge()
            await machine.again()
            m.status = ideal.COMPLETED
            return


async def all_flows(work: Work) -> Done:
    """Fly all missions side by side."""
    fleet = Fleet(work.drones)
    missions = [ideal.Mission(number, work.trips) for number in range(work.missions)]
    await asyncio.gather(*(live(m, fleet) for m in missions))
    return ideal.told(missions)


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    return asyncio.run(all_flows(work))


if __name__ == "__main__":
    main(fly)
