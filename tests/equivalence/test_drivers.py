"""The same package leaves the same trace in virtual time and in real time, event by event."""

from __future__ import annotations

from random import Random

from plutoc.compile import planned
from tests.equivalence.campaign import drawn
from tests.equivalence.drivers import in_real_time, seen
from tests.equivalence.flows import packaged
from tests.equivalence.fly import record
from tests.equivalence.worlds import random_world

GRAPHS = 8


def test_real_time_takes_simultaneous_events_in_the_order_of_virtual_time() -> None:
    """As long as hooks do not wait: those that do are tasks of asyncio's in real time."""
    events = 0
    for number in range(GRAPHS):
        text, checked, rng, _ = drawn(f"drivers/{number}")
        package = packaged(planned(checked))
        for _ in range(2):
            world = random_world(Random(rng.random()), package.graph)
            virtual = record(package, world, patient=False)
            real = record(package, world, patient=False, fly=in_real_time)
            if virtual.spins:
                continue
            whole = not virtual.ends[0].startswith(("BadInput", f"over after {world.until!r}"))
            assert seen(real, world, whole) == seen(virtual, world, whole), f"{text}\n{world}"
            events += len(virtual.events)
    assert events > 500
