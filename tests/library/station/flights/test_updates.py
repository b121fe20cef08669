"""What all pages see goes on, though something of it cannot be shown."""

from __future__ import annotations

import asyncio

import pytest

from pluto_fleet.station.session import FlightSession

from .conftest import Serve

SOON = 0.1
"""Seconds of the loop's time, which jumps."""


def test_a_mistake_in_what_is_shown_leaves_no_page_waiting_and_the_flight_flies_on(
    serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    station, complaints = serve().flying(), list[object]()
    station.world.loop.set_exception_handler(lambda _, about: complaints.append(about))
    with monkeypatch.context() as wrong:
        wrong.setattr(FlightSession, "look", lambda *_: 1 / 0)
        assert station.now()["state"]["phase"] == "flying"
        station.comes_to("over")
    assert complaints
    station.completes_all_once()


def test_a_page_that_has_seen_all_is_answered_when_something_changes_or_in_a_second(
    serve: Serve,
) -> None:
    station = serve()
    seen, loop = int(station.now()["version"]), station.world.loop

    async def answered(change: bool) -> float:
        """Return how long a page waits, if something changes soon or nothing does."""
        begun = loop.time()
        asked = asyncio.ensure_future(station.life.newer("", seen, 0, 0))
        await asyncio.sleep(SOON)
        if change:
            station.life.plan.example(station.life.plan.revision)
        await asked
        return loop.time() - begun

    assert station.world.run(answered(change=False)) == pytest.approx(1.1, abs=0.1)
    assert station.world.run(answered(change=True)) == pytest.approx(0.2, abs=0.1)
