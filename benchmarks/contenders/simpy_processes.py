"""SimPy: a process a mission, a resource of drones with priorities, and whichever of trip and timer
comes first. It hands out a drone, and does not say which.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

import simpy

from .ideal import COMPLETED, FAILED, RUNNING, STANDBY, Mission, told
from .process import Notes, main
from .work import LIMIT, Done, Work, fails


def flow(
    env: simpy.Environment, m: Mission, fleet: simpy.PriorityResource, flight: float
) -> Generator[Any, Any, None]:
    """Take one mission from start to end."""
    while True:
        request = fleet.request(priority=-m.priority)
        yield request
        m.status = RUNNING
        trip = env.timeout(flight, value=not fails(m.id, m.trip, m.attempt))
        timer = env.timeout(LIMIT)
        first = yield trip | timer
        fleet.release(request)
        if trip not in first or not first[trip]:
            m.status = FAILED
            m.failed_trips += 1
            m.attempt += 1
            m.priority += 1
            continue
        m.done_trips += 1
        m.trip += 1
        m.attempt = 0
        if m.trip < m.trips:
            m.status = STANDBY
            continue
        m.status = COMPLETED
        return


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    env = simpy.Environment()
    fleet = simpy.PriorityResource(env, capacity=work.drones)
    missions = [Mission(number, work.trips) for number in range(work.missions)]
    for m in missions:
        env.process(flow(env, m, fleet, work.flight))
    env.run()
    return told(missions)


if __name__ == "__main__":
    main(fly)
