"""One forecast at a time: the newest wins, nothing waits for it, and nothing of it is left behind."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncGenerator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.preflight import preflight as running
from pluto_fleet.station.preflight.preflight import Newer, Preflight
from pluto_fleet.station.preflight.runs import Found, Needs, Run
from pluto_fleet.station.preflight.start import PlannedStart
from pluto_fleet.station.station import Station
from pluto_fleet.station.web.audit import Audit
from pluto_fleet.station.web.forecasts import GONE
from pluto_fleet.station.web.forecasts import preflight as answered
from pluto_fleet.station.web.http import Request
from pluto_fleet.station.web.served import Asked
from pluto_fleet.station.wire import Forecast
from tests.library.files.an_app import APP
from tests.library.station.jumping import JumpingLoop
from tests.library.station.plan.drawing import drawn
from tests.library.station.preflight.asking import FLEET, photos, question
from tests.library.station.server.asking import AStation

ONE = photos("mission-one", 1)


@dataclass(slots=True)
class Copies:
    """Forecasts that fly one run and then hang, until they are ended."""

    flying: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(0))
    here: int = 0
    """How many have begun and not ended."""

    async def hang(self, _: object) -> AsyncGenerator[Found, None]:
        """Do as the copy of the process does in which a forecast is made."""
        self.here += 1
        try:
            yield Needs({}, {})
            yield Run(seed=0, seconds=1.0, ends={}, battery=None, given_up="")
            self.flying.release()
            await asyncio.Event().wait()
        finally:
            self.here -= 1

    async def begun(self) -> None:
        """Wait until one more flies."""
        await self.flying.acquire()


@pytest.fixture
def copies(monkeypatch: pytest.MonkeyPatch) -> Copies:
    """Let each forecast fly one run and then hang, until it is ended."""
    copies = Copies()
    monkeypatch.setattr(running, "in_a_copy", copies.hang)
    return copies


def test_a_newer_one_ends_the_one_that_flies(tmp_path: Path, copies: Copies) -> None:
    async def both() -> None:
        preflight = Preflight(tmp_path)
        first = asyncio.ensure_future(preflight.ask(question(ONE), ["mission-one"], []))
        await copies.begun()
        second = asyncio.ensure_future(preflight.ask(question(ONE), ["mission-one"], []))
        with pytest.raises(Newer, match="a newer one was asked for"):
            await first
        await copies.begun()
        second.cancel()
        with pytest.raises(asyncio.CancelledError):
            await second
        assert copies.here == 0

    asyncio.run(both())
    assert not (tmp_path / "rehearsals").exists()


def test_a_stop_is_answered_and_pages_are_told_while_one_flies_and_a_new_plan_ends_it(
    tmp_path: Path, copies: Copies
) -> None:
    async def station() -> None:
        settings = StationConfig(folder=tmp_path, fleet=FLEET, faults={})
        settings.own_folder.mkdir()
        plan = drawn(ONE, fleet=FLEET)
        served = Station(APP, settings, plan)
        served.begin()
        asked = PlannedStart(revision=plan.revision)
        making = asyncio.ensure_future(served.forecast(asked))
        await copies.begun()
        assert await served.command("stop", "one", {"how": "land"}, "") == "nothing flies"
        assert '"phase": "idle"' in await served.newer("", 0, 0, 0)
        assert not making.done()
        plan.replace(plan.revision, [{**ONE, "name": "Another"}])
        with pytest.raises(Newer, match="the plan has changed"):
            await making
        with pytest.raises(Newer, match="the plan has changed"):
            await served.forecast(asked)
        assert copies.here == 0

    asyncio.run(station())


def test_it_is_given_up_when_its_client_goes_away(tmp_path: Path, copies: Copies) -> None:
    preflight = Preflight(tmp_path)

    class Served(AStation):
        async def forecast(self, asked: PlannedStart, /) -> Forecast:
            return await preflight.ask(question(ONE), ["mission-one"], [])

    async def asked() -> None:
        request = Request(method="POST", path="/api/preflight", gone=copies.begun)
        given: dict[str, object] = {"revision": 1, "missions": None}
        one = Asked(
            station=Served(), audit=Audit(None), request=request, role="fly", given=given, body=b""
        )
        assert await answered(one) is GONE
        assert copies.here == 0

    asyncio.run(asked())


def test_one_that_has_flown_nothing_in_time_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def silent(_: object) -> AsyncGenerator[Found, None]:
        await asyncio.Event().wait()
        yield Needs({}, {})

    async def cut_off() -> None:
        with pytest.raises(BadInput, match="not even one run of this plan was flown within"):
            await Preflight(tmp_path).ask(question(ONE), ["mission-one"], [])

    monkeypatch.setattr(running, "in_a_copy", silent)
    with asyncio.Runner(loop_factory=JumpingLoop) as runner:
        runner.run(cut_off())
