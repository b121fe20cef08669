"""Subscribers hear of the drones, each at its own rate, and only what has changed."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping

from pluto_fleet.jobs.telemetry import Subscription, Telemetry
from tests.kit.drones import run
from tests.library.gateway.flights import Field

News = Mapping[str, bool]


def landed(drone: str, known: Telemetry) -> bool:
    return known.landed


def test_each_subscriber_hears_at_its_own_rate_of_what_changed() -> None:
    field, fast, slow, looks = Field(), list[News](), list[News](), list[float]()

    def hear(news: News, late: float) -> None:
        fast.append(news)
        if len(fast) == 1:
            field.navigation.bodies["cf1"].follow([(1.0, 1.0, 1.2)])

    async def hears() -> None:
        drones = field.navigation.telemetry
        subscriptions = (
            Subscription(drones, hear, every=0.01, view=landed, unchanged=60),
            Subscription(
                drones, lambda news, _: slow.append(news), every=0.1, view=landed, unchanged=60
            ),
            Subscription(drones, lambda _, late: looks.append(late), every=0.01, view=landed),
        )
        while not slow or len(looks) < 3:
            await asyncio.sleep(0.01)
        for subscription in subscriptions:
            subscription.cancel()
        so_far = len(looks)
        await asyncio.sleep(0.05)
        assert len(looks) == so_far

    run(hears())
    on_the_ground = dict.fromkeys(field.navigation.telemetry, True)
    assert fast == [on_the_ground, {"cf1": False}]
    assert slow == [{**on_the_ground, "cf1": False}]
    assert min(looks) >= 0
