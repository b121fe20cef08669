"""One forecast at a time: the newest wins, nothing waits for it, and nothing of it is left behind."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from pluto_fleet.process.beside import Died, in_a_copy
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.preflight import preflight as running
from pluto_fleet.station.preflight.preflight import Newer, Preflight
from pluto_fleet.station.preflight.question import Question
from pluto_fleet.station.preflight.runs import Found, Needs, Run
from pluto_fleet.station.preflight.start import PlannedStart
from pluto_fleet.station.station import Station
from pluto_fleet.station.web.audit import Audit
from pluto_fleet.station.web.forecasts import GONE
from pluto_fleet.station.web.forecasts import preflight as answered
from pluto_fleet.station.web.http import Request
from pluto_fleet.station.web.served import Asked
from pluto_fleet.station.wire import Forecast
from tests.forks import recorded
from tests.kit.station import PATIENCE
from tests.library.files.an_app import APP
from tests.library.station.plan.drawing import drawn
from tests.library.station.preflight.asking import FLEET, photos, question
from tests.library.station.server.asking import AStation

ONE = photos("mission-one", 1)


@dataclass(slots=True)
class Copies:
    """The processes of forecasts that fly one run and then hang, until they are ended."""

    forked: list[int]
    flying: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(0))

    def of(self, preflight: Preflight) -> None:
        """Count those of this preflight that fly."""
        preflight.begun = self.flying.release

    async def begun(self) -> None:
        """Wait until one more flies."""
        async with asyncio.timeout(PATIENCE):
            await self.flying.acquire()

    async def ended(self) -> None:
        """Wait until none is left; other tests may have left children of this process."""
        assert self.forked
        async with asyncio.timeout(PATIENCE):
            while any(map(_is_there, self.forked)):
                await asyncio.sleep(0.01)


def _is_there(child: int) -> bool:
    try:  # only a look: it is reaped where it is read
        os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    except ChildProcessError:
        return False
    return True


@pytest.fixture
def copies(monkeypatch: pytest.MonkeyPatch) -> Iterator[Copies]:
    """Let each forecast fly one run and then hang, until its process is ended."""
    reads, writes = os.pipe()

    def hangs(asked: Question, recording: Path | None) -> Iterator[Found]:
        yield Needs({}, {})
        yield Run(seed=0, seconds=1.0, ends={}, battery=None, given_up="")
        os.read(reads, 1)

    with monkeypatch.context() as patched:
        patched.setattr(running, "found", hangs)
        yield Copies(recorded(patched))
    os.close(reads)
    os.close(writes)


def test_a_newer_one_ends_the_one_that_flies(tmp_path: Path, copies: Copies) -> None:
    async def both() -> None:
        preflight = Preflight(tmp_path)
        copies.of(preflight)
        first = asyncio.ensure_future(preflight.ask(question(ONE), ["mission-one"], []))
        await copies.begun()
        second = asyncio.ensure_future(preflight.ask(question(ONE), ["mission-one"], []))
        with pytest.raises(Newer, match="a newer one was asked for"):
            await first
        await copies.begun()
        second.cancel()
        with pytest.raises(asyncio.CancelledError):
            await second
        await copies.ended()

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
        copies.of(served.preflight)
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
        await copies.ended()

    asyncio.run(station())


def test_it_is_given_up_when_its_client_goes_away(tmp_path: Path, copies: Copies) -> None:
    preflight = Preflight(tmp_path)
    copies.of(preflight)

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
        await copies.ended()

    asyncio.run(asked())


def test_one_that_has_flown_nothing_in_time_is_refused(
    tmp_path: Path, copies: Copies, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(running, "FIRST_WITHIN", 0.0)

    async def cut_off() -> None:
        with pytest.raises(BadInput, match="not even one run of this plan was flown within"):
            await Preflight(tmp_path).ask(question(ONE), ["mission-one"], [])
        await copies.ended()

    asyncio.run(cut_off())


class Unreadable:
    """Can be sent, and not be received."""

    def __reduce__(self) -> tuple[Callable[[str], int], tuple[str]]:
        return int, ("none",)


def test_what_cannot_be_read_is_raised() -> None:
    async def found() -> list[object]:
        return [one async for one in in_a_copy(lambda: [Unreadable()])]

    with pytest.raises(ValueError, match="none"):
        asyncio.run(asyncio.wait_for(found(), PATIENCE))


def test_what_goes_wrong_in_a_copy_is_raised_here_and_its_death_is_told() -> None:
    async def found(code: int | None) -> list[int]:
        def work() -> Iterator[int]:
            print("it is not printed")
            yield 1
            if code is None:
                raise LookupError("of a hook")
            if code == 0:
                raise SystemExit
            os.kill(os.getpid(), code)

        return [one async for one in in_a_copy(work)]

    with pytest.raises(LookupError, match="of a hook"):
        asyncio.run(found(None))
    with pytest.raises(Died, match="ended by SystemExit"):  # and not this process
        asyncio.run(found(0))
    with pytest.raises(Died, match="was killed by SIGKILL"):
        asyncio.run(found(9))
