"""While all that reads flights of the past is held up, drones come down and pages are answered."""

from __future__ import annotations

import asyncio
import os
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from pluto_fleet.process.apart import Apart
from pluto_fleet.station import station as a_station
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.flight_files import FlightFiles
from pluto_fleet.station.history.past import PastFlights
from pluto_fleet.station.station import Station
from tests.library.files.an_app import APP
from tests.library.process.holding import held
from tests.library.station.in_threads import InThreads
from tests.library.station.plan.drawing import FLEET, a_plan

from .asking import NOWHERE, AStation, asked, request, said


@pytest.mark.process
def test_a_stop_and_a_page_are_answered_while_hostile_questions_are_at_work(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Each of them keeps Python's own lock; and they take no more than half of all places."""
    reads, writes = os.pipe()
    monkeypatch.setattr(PastFlights, "flights", lambda files: held(files, reads).decode())
    with closing(Apart(FlightFiles(APP, NOWHERE))) as files:
        asyncio.run(_asked_meanwhile(files, lambda: os.write(writes, b"x" * 32)))
    os.close(reads)
    os.close(writes)


async def _asked_meanwhile(files: Apart[FlightFiles], let_go: Callable[[], object]) -> None:
    station = AStation(files=files)
    ask = asked(station).api.answer
    hostile = []
    for _ in range(40):
        hostile.append(asyncio.ensure_future(ask(request("GET", "/api/flights"))))
        await asyncio.sleep(0)
    for path in ("/", "/api/app", "/api/plan", "/api/live"):
        assert (await ask(request("GET", path))).status == 200
    assert (await ask(request("POST", "/api/start", {"id": "a"}))).status == 200
    assert (await ask(request("POST", "/api/stop", {"id": "b", "how": "land"}))).status == 200
    assert [name for name, _ in station.done] == ["start", "stop"]
    assert [one.result().status for one in hostile if one.done()] == [503] * 8
    let_go()
    assert [(await one).status for one in hostile] == [200] * 32 + [503] * 8


@pytest.mark.long
@pytest.mark.process
def test_when_the_process_that_reads_flights_dies_it_is_said_and_the_next_is_asked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(PastFlights, "hours", lambda _: os.kill(os.getpid(), 9))

    async def scene(files: Apart[FlightFiles]) -> None:
        ask = asked(AStation(files=files)).api.answer
        reply = await ask(request("GET", "/api/drones/hours"))
        assert (reply.status, "ask again" in said(reply)) == (503, True)
        assert (await ask(request("GET", "/api/flights"))).body == b"[]"

    with closing(Apart(FlightFiles(APP, NOWHERE))) as files:
        asyncio.run(scene(files))


@pytest.mark.parametrize(
    ("command", "given"), [("stop", {"how": "land"}), ("cut-motors", {"drone": "cf1"})]
)
def test_what_brings_drones_down_without_their_app_is_queued_behind_no_other_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str, given: dict[str, Any]
) -> None:
    monkeypatch.setattr(a_station, "stop_directly", lambda *_: "down")
    monkeypatch.setattr(a_station, "cut_directly", lambda *_: "down")
    config = StationConfig(folder=tmp_path, fleet=FLEET, faults={})
    config.own_folder.mkdir()
    over = threading.Event()

    async def scene() -> str:
        asyncio.get_running_loop().set_default_executor(ThreadPoolExecutor(1))
        works = asyncio.ensure_future(asyncio.to_thread(over.wait))
        await asyncio.sleep(0)
        station = Station(APP, config, a_plan(), InThreads(APP, config))
        crashed = SimpleNamespace(lives=False, known=None, journal=tmp_path / "a.journal")
        station.session = cast(Any, crashed)
        said = await station.command(command, "one", given)
        over.set()
        await works
        return said

    assert asyncio.run(scene()) == "down"
