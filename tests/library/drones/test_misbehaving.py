"""Navigations that hang, raise any error, or hold up the whole loop: no other drone suffers."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Sequence
from pathlib import Path
from typing import cast

import pytest

from pluto_fleet.drones.protocol import BATTERY_LOW, DroneEvent, NavigationError
from pluto_fleet.jobs.controls import Act, Cut, GoTo, Hold, Land, Read, TakeOff, Write
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from tests.kit.drones import FakeDrone, the_loop
from tests.library.drones.teams import Flown, flying

METHODS = (
    "preflight",
    "takeoff",
    "go_to",
    "hold",
    "land",
    "act",
    "read",
    "write",
    "events",
    "emergency_stop",
    "close",
)


async def everything(flown: Flown, drone: str = "cf1") -> list[str]:
    """Ask for everything there is, and return what went wrong."""
    team = flown.team
    wrong: list[str] = []
    for command in (
        team.do(drone, TakeOff(1.0)),
        team.do(drone, GoTo((2.0, 2.0, 1.0))),
        team.do(drone, Act("measure", {}, None, None)),
        team.do(drone, Read("range.front")),
        team.do(drone, Write("led", 1.0)),
        team.do(drone, Land()),
        team.do(drone, Cut()),
    ):
        try:
            await flown.do(command)
        except FlightFailed as error:
            wrong.append(str(error))
    return wrong


@pytest.mark.parametrize("clings", [False, True])
@pytest.mark.parametrize("method", ["connect", *METHODS])
async def test_a_navigation_that_hangs_hangs_nothing(
    tmp_path: Path, method: str, clings: bool
) -> None:
    """In any of its methods, and even if it does not let go: all else goes on within limits."""
    drones = FakeDrone(), FakeDrone("cf2", (3.0, 1.0, 0.0))
    async with flying(tmp_path, *drones) as flown:
        await flown.do(flown.team.drone_report("cf1"))
        drones[0].hangs = {method}
        drones[0].clings = {method} if clings else set()
        before = the_loop().now
        hanging = asyncio.ensure_future(everything(flown))
        assert await everything(flown, "cf2") == []
        assert the_loop().now - before < 20
        wrong = await hanging
        if method not in ("connect", "hold", "events", "close"):
            assert wrong[0].startswith("cf1 ")
        before = the_loop().now
        drones[0].hangs -= {"land"}
    assert the_loop().now - before < 60


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "error", [TypeError("what?"), SystemExit(3), asyncio.CancelledError(), NavigationError("no")]
)
async def test_a_navigation_that_raises_fails_its_own_flight(
    tmp_path: Path, method: str, error: BaseException
) -> None:
    """A mistake is named, and its traceback is in the log; what it declares is a reason."""
    drones = FakeDrone(), FakeDrone("cf2", (3.0, 1.0, 0.0))
    drones[0].raises = {method: error}
    async with flying(tmp_path, *drones) as flown:
        for drone in flown.drones:
            await flown.do(flown.team.drone_report(drone))
        wrong = await everything(flown)
        assert await everything(flown, "cf2") == []
        if method not in ("hold", "events", "close"):
            what = str(error) or "CancelledError"
            assert any(what in one for one in wrong)
            if not isinstance(error, NavigationError):
                assert any("the navigation of cf1 made a mistake: " in one for one in wrong)
        if isinstance(error, (TypeError, SystemExit)) and method != "hold":
            await flown.team.close()
            assert any("Traceback" in line for line in flown.log)


async def test_a_failure_counts_by_what_it_says_of_itself(tmp_path: Path) -> None:
    """A navigation may have been written against another copy of the runtime."""

    class Stranger(Exception):
        failure = "BATTERY"

    class Odd(Exception):
        failure = 7

    async with flying(tmp_path) as flown:
        drone = await flown.up()
        drone.raises = {"go_to": Odd("x" * 1000)}
        failed = await flown.failure(flown.team.do("cf1", GoTo((2, 2, 1))))
        assert failed.failure is Failure.ACTION
        assert len(str(failed)) < 400
        drone.raises = {"go_to": Stranger("too little left\x07")}
        failed = await flown.failure(flown.team.do("cf1", GoTo((2, 2, 1))))
        assert (failed.failure, str(failed)) == (Failure.BATTERY, "too little left\\x07")


async def test_who_holds_up_the_loop_is_named(tmp_path: Path) -> None:
    """And no other is taken to be silent for that."""
    async with flying(tmp_path, FakeDrone(), FakeDrone("cf2", (3.0, 1.0, 0.0))) as flown:
        drone = await flown.up()
        await flown.up("cf2")
        hovers = flown.begin(flown.team.do("cf2", Hold()))
        drone.blocks = {"go_to": 0.4}
        await flown.do(flown.team.do("cf1", GoTo((2, 1, 1))))
        assert "the navigation of cf1 blocked for 0.4 s" in flown.log
        drone.blocks = {"go_to": 3.0}
        await flown.do(flown.team.do("cf1", GoTo((3, 1, 1))))
        assert not hovers.is_set


async def test_telemetry_that_makes_no_sense_is_silence(tmp_path: Path) -> None:
    """A drone that does not know where it is cannot be flown."""
    async with flying(tmp_path) as flown:
        drone = await flown.up()
        seen = flown.team.telemetry["cf1"]
        before = seen.location
        drone.put((float("nan"), 1.0, 1.0))
        failed = await flown.failure(flown.team.do("cf1", Hold()))
        assert failed.failure is Failure.LINK
        assert seen.location == before
        drone.put((1.0, 1.0, 1.0))
        drone.raises = {"telemetry": KeyError("x")}
        assert seen.location == before
        assert any("made a mistake: KeyError" in line for line in flown.log)
        drone.raises = {}


async def test_answers_that_are_none_are_mistakes(tmp_path: Path) -> None:
    """No matter what a navigation gives: no caller falls over that."""

    class Odd(FakeDrone):
        async def read(self, name: str) -> float:
            return cast("float", "much")

        async def preflight(self) -> Sequence[str]:
            return cast("Sequence[str]", self.says)

        says: object = 7

    drone = Odd()
    async with flying(tmp_path, drone) as flown:
        problems = (await flown.do(flown.team.drone_report("cf1"))).problems
        assert problems == ("its preflight gave no list of reasons",)
        drone.says = [None] * 1000
        assert len((await flown.do(flown.team.drone_report("cf1"))).problems) == 20
        drone.says = ()
        await flown.do(flown.team.do("cf1", TakeOff(1.0)))
        assert "made a mistake: ValueError" in str(
            await flown.failure(flown.team.do("cf1", Read("range.front")))
        )
        drone.events_told(cast("DroneEvent", object()))
        drone.happens(BATTERY_LOW)
        await flown.until(lambda: not drone.motors)


async def test_one_that_is_never_out_of_news_holds_up_no_one(tmp_path: Path) -> None:
    """Its events come one after the other without a pause; the log is not filled with them."""

    class Chatty(FakeDrone):
        async def events(self) -> AsyncIterator[DroneEvent]:
            while True:
                yield DroneEvent(kind="news", reason="still here")

    chatty, other = Chatty(), FakeDrone("cf2", (3.0, 1.0, 0.0))
    async with flying(tmp_path, chatty, other) as flown:
        await flown.up("cf2")
        await flown.until(lambda: the_loop().now > 1005)
        assert flown.log.count("cf1: news: still here") == 1


async def test_if_the_watch_breaks_all_ends_and_all_land_first(tmp_path: Path) -> None:
    """No drone flies that is not watched."""
    drone = FakeDrone()
    with pytest.raises(ZeroDivisionError):
        async with flying(tmp_path, drone) as flown:
            await flown.up()
            flown.team.vehicles["cf1"].position_problem = lambda: str(1 / 0)
            await flown.until(lambda: flown.kernel.crashed)
    assert not drone.motors
