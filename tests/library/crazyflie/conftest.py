"""Flights of Crazyflies take no time: cflib runs in their own thread, on a loop whose clock jumps."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from pathlib import Path

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from tests.kit.unthreaded import AirLoop, one_thread
from tests.library.crazyflie.hangar import Hangar, hangar
from tests.loops import run_async


@pytest.fixture
def runner() -> Iterator[asyncio.Runner]:
    """The loop in which a test flies; no task may be left in it."""
    pytest.importorskip("cflib")
    with one_thread(), asyncio.Runner(loop_factory=AirLoop) as runner:
        yield runner
        assert not asyncio.all_tasks(runner.get_loop())


@pytest.fixture
def one(request: pytest.FixtureRequest, runner: asyncio.Runner, tmp_path: Path) -> Iterator[Hangar]:
    """A drone that nobody has connected to yet; `drone` says what is special of it."""
    made = hangar(tmp_path, **getattr(request, "param", {}))
    yield runner.run(made.__aenter__())
    runner.run(made.__aexit__(None, None, None))


@pytest.fixture
def cf(runner: asyncio.Runner, one: Hangar) -> Crazyflie:
    """What flies it, connected."""
    return runner.run(one.connected())


@pytest.fixture
def up(runner: asyncio.Runner, one: Hangar) -> Crazyflie:
    """What flies it, hovering half a metre high."""
    return runner.run(one.up())


@pytest.fixture
def folder(runner: asyncio.Runner, tmp_path: Path) -> Path:
    return tmp_path


def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    if "runner" not in pyfuncitem.fixturenames:
        return None
    runner: asyncio.Runner = pyfuncitem.funcargs["runner"]  # type: ignore[assignment]
    return run_async(pyfuncitem, runner.run)
