"""One forecast at a time: the newest wins, nothing waits for it, and nothing of it is left behind."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncGenerator
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.preflight import preflight as running
from pluto_fleet.station.preflight.preflight import Newer, PlannedStart, Preflight
from pluto_fleet.station.preflight.runs import Found, Needs, Run
from pluto_fleet.station.station import Station
from pluto_fleet.station.web.api import Api
from pluto_fleet.station.web.audit import Audit
from pluto_fleet.station.web.guard import Guard
from tests.library.files.an_app import APP
from tests.library.station.in_threads import InThreads
from tests.library.station.jumping import run
from tests.library.station.plan.drawing import drawn
from tests.library.station.preflight.asking import FLEET, photos, question
from tests.library.station.server.asking import Asgi, request

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


@pytest.fixture
def served(tmp_path: Path) -> Station:
    """A station where one mission could be started."""
    settings = StationConfig(folder=tmp_path, fleet=FLEET, faults={})
    settings.own_folder.mkdir()
    return Station(APP, settings, drawn(ONE, fleet=FLEET), InThreads(APP, settings))


async def test_a_newer_one_or_a_new_plan_ends_the_one_that_flies_and_all_else_is_answered_meanwhile(
    served: Station, copies: Copies, tmp_path: Path
) -> None:
    served.begin()
    asked = PlannedStart(revision=served.plan.revision)
    first = asyncio.ensure_future(served.forecast(asked))
    await copies.begun()
    second = asyncio.ensure_future(served.forecast(asked))
    with pytest.raises(Newer, match="a newer one was asked for"):
        await first
    await copies.begun()
    assert await served.command("stop", "one", {"how": "land"}) == "nothing flies"
    assert '"phase": "idle"' in await served.newer("", 0, 0, 0)
    assert not second.done()
    served.plan.replace(served.plan.revision, [{**ONE, "name": "Another"}])
    with pytest.raises(Newer, match="the plan has changed"):
        await second
    with pytest.raises(Newer, match="the plan has changed"):
        await served.forecast(asked)
    assert copies.here == 0
    assert not (tmp_path / "rehearsals").exists()


async def test_it_is_given_up_when_its_client_goes_away(served: Station, copies: Copies) -> None:
    given = {"revision": served.plan.revision, "missions": None}
    asked = replace(request("POST", "/api/preflight", given), gone=copies.begun)
    api = Asgi(Api(served, Guard(host="127.0.0.1", port=8765), Audit(None)))
    assert (await api.answer(asked)).status == 499
    assert copies.here == 0


def test_one_that_has_flown_nothing_in_time_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def silent(_: object) -> AsyncGenerator[Found, None]:
        await asyncio.Event().wait()
        yield Needs({}, {})

    monkeypatch.setattr(running, "in_a_copy", silent)
    with pytest.raises(BadInput, match="not even one run of this plan was flown within"):
        run(Preflight(tmp_path).ask(question(ONE), ["mission-one"], []))
