"""One drone leaves the same events under every driver: ideal drones, a gateway in virtual time, asyncio."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from pluto_fleet.shared.domain.motion import CRAZYFLIE, STRAIGHT
from tests.equivalence.campaign import OURS, drawn
from tests.equivalence.drivers import in_real_time, seen
from tests.equivalence.flows import packaged
from tests.equivalence.fly import alone, difference, record
from tests.equivalence.worlds import random_world

MOTIONS = (
    STRAIGHT,
    CRAZYFLIE,
    replace(CRAZYFLIE, spread=0.2, action_spread=0.2, drain=2.0, pace=0.7),
)
"""For each graph; its drone moves each time in another way."""


def flown(name: str, worlds: int) -> int:
    """Fly a random graph in some worlds by all three, and return how many events there were."""
    text, checked, rng, _ = drawn(name)
    package = packaged(OURS.planner(checked))
    events = 0
    for number in range(worlds):
        world = random_world(Random(rng.random()), package.graph)
        motion = MOTIONS[(number + len(text)) % len(MOTIONS)]
        world = replace(world, homes=world.homes[:1], motion=motion)
        with_traffic = record(package, world, patient=False)
        by_itself = record(package, world, patient=False, fly=alone)
        assert difference(with_traffic, by_itself) is None, f"{text}\n{world}"
        if with_traffic.spins:
            continue
        real = record(package, world, patient=False, fly=in_real_time)
        cut_off = ("BadInput", f"over after {world.until!r}")  # by asyncio at that very instant
        whole = not any(run.ends[0].startswith(cut_off) for run in (with_traffic, real))
        assert seen(real, world, whole) == seen(with_traffic, world, whole), f"{text}\n{world}"
        events += len(with_traffic.events)
    return events


def test_one_drone_leaves_the_same_events_under_every_driver() -> None:
    """Byte for byte, also where things go wrong."""
    assert sum(flown(f"same/{number}", 3) for number in range(6)) > 150
