"""The gateway as a program of its own: its socket, its files, and its end, be that a kill."""

from __future__ import annotations

import asyncio
import os
import signal
from math import dist
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from pluto_fleet.gateway import remote, starting
from pluto_fleet.gateway.process import LOG, Ending, main
from pluto_fleet.gateway.starting import (
    connect,
    cut_directly,
    let_end,
    speed_in,
    still_runs,
    stop_directly,
)
from pluto_fleet.jobs.reports import Down, FleetReport, JobState
from pluto_fleet.process.ipc import line
from pluto_fleet.shared.domain.errors import BadInput, Failure, FlightFailed
from pluto_fleet.shared.domain.model import Photo
from pluto_fleet.shared.time.kernel import FLEET, Future
from tests.library.gateway.flights import SCOUT, THERE, Commander, Field, Task
from tests.library.gateway.processes import (
    SPEED,
    Brain,
    InsideBrain,
    deeds,
    pid,
    played,
    played_inside,
    settings,
)

FAR = (18.0, 18.0, 1.2)
PICK = ("cf1", "pick_item", Task().id)


async def sent_far(brain: Brain, drone: str = "cf1") -> Commander:
    """Link, send a drone far away, and return the link when it is on its way."""
    link = await brain.linked()
    brain.kernel.post(link.fly, Task(id=drone, drone=drone, stops=(FAR,)), lambda _: None)
    await brain.until(lambda: link.telemetry(drone).location[0] > 3)
    return link


def states(report: FleetReport) -> dict[str, JobState]:
    return {id: job.state for id, job in report.jobs.items()}


def test_a_job_is_flown_through_it(tmp_path: Path) -> None:
    """Its action begins once and is done once; photos arrive whole; telemetry stays current."""

    async def play(brain: InsideBrain) -> None:
        link = await brain.linked()
        assert await brain.flown(link, Task()) is None
        assert link.telemetry("cf1").location == pytest.approx(THERE)
        assert not link.telemetry("cf1").landed
        photo = await brain.flown(link, Task(id="photo", action="take_photo", item=None))
        assert isinstance(photo, Photo)
        report = await brain.told(link.fleet_report())
        assert states(report) == dict.fromkeys((Task().id, "photo"), JobState.DONE)
        assert report.jobs["photo"].value == photo
        assert report.drones["cf1"].carrying == "pills"
        await brain.told(link.land("cf1"))
        whats = ["take_off", "leg", "action", "leg", "action", "land"]
        assert [one["what"] for one in link.flown] == whats  # each before what follows from it
        assert link.telemetry("cf1").landed
        await link.link.goodbye()
        assert not brain.lost.is_set
        await brain.until(lambda: not brain.gateway_runs)

    played_inside(tmp_path, play)
    assert deeds(tmp_path) == [PICK, ("cf1", "take_photo", "photo")]


def test_a_drone_behind_a_socket_keeps_what_it_is_set_to(tmp_path: Path) -> None:
    """While it hovers for an action of the app's own; a drone on the ground refuses."""

    async def play(brain: InsideBrain) -> None:
        link = await brain.linked()
        await brain.flown(link, Task(action=None))
        hover = brain.kernel.spawn(link.hold("cf1"), FLEET, "an action")
        await brain.told(link.ask("write", "cf1", name="gripper.closed", value=1.0))
        assert await brain.told(link.ask("read", "cf1", name="gripper.closed")) == 1.0
        assert not hover.is_set
        with pytest.raises(FlightFailed, match="it must take off first") as refused:
            await brain.told(link.ask("read", "cf2", name="gripper.closed"))
        assert refused.value.failure is Failure.REFUSED
        hover.cancel()

    played_inside(tmp_path, play)


def test_a_brain_that_is_gone_finds_its_job_flying_on(tmp_path: Path) -> None:
    """It links again in time, attaches, and hears the end."""

    async def play(brain: InsideBrain) -> None:
        link = await sent_far(brain)
        await link.link.close()
        link = await brain.linked()
        job = (await brain.told(link.fleet_report())).jobs["cf1"]
        assert (job.state, job.flies) == (JobState.FLYING, True)
        heard: list[object] = []
        brain.kernel.post(link.attach, "cf1", heard.append)
        await brain.until(lambda: bool(heard))
        assert heard == [None]

    played_inside(tmp_path, play)
    assert deeds(tmp_path) == [("cf1", "pick_item", "cf1")]


@pytest.mark.parametrize("speed", [5.0, 400.0])
def test_a_gateway_that_lives_passes_its_time_as_the_next_brain_asks(
    tmp_path: Path, speed: float
) -> None:
    """From where its drones are by then: nothing jumps; and the next resume finds that speed."""

    async def play(brain: InsideBrain) -> None:
        link = await sent_far(brain)
        await link.link.close()
        where = link.telemetry("cf1").location
        brain.pass_at(speed)
        link = await brain.linked()
        there = link.telemetry("cf1").location
        at = asyncio.get_running_loop().time()
        assert dist(where, there) < 2.0
        await brain.until(lambda: dist(there, link.telemetry("cf1").location) >= 3.0)
        seconds = (asyncio.get_running_loop().time() - at) * speed
        assert seconds == pytest.approx(3.0 / SCOUT.speed, rel=0.2, abs=0.3 * speed)
        assert speed_in(tmp_path) == speed

    played_inside(tmp_path, play)


def test_without_a_brain_everything_lands_and_then_it_ends(tmp_path: Path) -> None:
    """The world stays as it is on the disk: the next gateway finds the drone where it landed."""

    async def play(brain: InsideBrain) -> None:
        link = await sent_far(brain)
        await link.link.close()
        await brain.until(lambda: not brain.gateway_runs)
        link = await brain.linked()
        assert link.telemetry("cf1").landed
        assert 3 < link.telemetry("cf1").location[0] < FAR[0]
        assert (await brain.told(link.fleet_report())).jobs == {}

    played_inside(tmp_path, play, patience=0.1, idle=0.5)


def test_all_can_be_brought_down_by_the_brain_and_without_it(tmp_path: Path) -> None:
    """Home at the brain's word; where they are at that of any program on the socket."""

    async def play(brain: InsideBrain) -> None:
        link = await sent_far(brain)
        await brain.told(link.bring_down(Down.HOME))
        assert link.telemetry("cf1").landed
        assert link.telemetry("cf1").location == pytest.approx((1, 1, 0))
        assert states(await brain.told(link.fleet_report())) == {"cf1": JobState.BROKEN_OFF}
        await sent_far(brain)
        [answer] = await brain.tells(line({"do": "stop", "how": "land"}))
        assert answer == {"ok": True, "said": "the drones come down"}
        await brain.kernel.run(brain.lost)
        link = await brain.linked()
        report = await brain.told(link.fleet_report())
        assert report.drones["cf1"].landed
        assert report.drones["cf1"].location[0] > 3

    played_inside(tmp_path, play)


def test_one_that_is_told_to_end_leaves_its_brain_time_to_stop() -> None:
    """The same signal may have reached both: the brain brings its drones down by itself."""
    field, over = Field(), Future[None]()
    settings: Any = SimpleNamespace(speed=1.0, idle=60.0, patience=3.0, real=None)
    server: Any = SimpleNamespace(has_a_brain=True)
    ending = Ending(field.gateway, over, settings)
    ending.server = server
    ending.look()
    field.advance(10)
    ending.told_to_end()
    field.advance(2.5)
    assert not over.is_set
    field.advance(2)
    assert over.is_set


def test_an_older_brain_is_refused_and_a_newer_one_cuts_it_off(tmp_path: Path) -> None:
    """The numbers come from the journal, and only grow."""

    async def play(brain: InsideBrain) -> None:
        brain.epoch = 5
        await brain.linked()
        lost = brain.lost
        await brain.linked()
        await brain.kernel.run(lost)
        brain.epoch = 2
        with pytest.raises(BadInput, match="another run of this app has taken over"):
            await brain.linked()

    played_inside(tmp_path, play)


@pytest.mark.process
def test_a_gateway_that_is_killed_comes_back_to_the_same_world(tmp_path: Path) -> None:
    """The brain notices; drones went on meanwhile; what was done is done, what was not is flown.

    In the end any program brings all down, and it ends when it is asked to.
    """

    async def play(brain: Brain) -> None:
        link = await brain.linked()
        await brain.flown(link, Task())
        link = await sent_far(brain, "cf2")
        killed = pid(tmp_path)
        assert killed is not None
        assert (still_runs(tmp_path), speed_in(tmp_path)) == (killed, SPEED)
        os.kill(killed, signal.SIGKILL)
        await brain.kernel.run(brain.lost)
        link = await brain.linked()
        report = await brain.told(link.fleet_report())
        assert pid(tmp_path) != killed
        assert states(report) == {Task().id: JobState.DONE}
        assert report.drones["cf1"].carrying == "pills"
        assert not report.drones["cf2"].landed
        assert report.drones["cf2"].location[0] > 3
        assert await brain.flown(link, Task(id="cf2", drone="cf2", stops=(FAR,))) is None
        assert cut_directly(tmp_path, "cf1", 5) == "the motors of cf1 are cut"
        assert stop_directly(tmp_path, Down.LAND, 5) == "the drones come down"
        await brain.kernel.run(brain.lost)
        let_end(tmp_path)
        await brain.until(lambda: still_runs(tmp_path) is None)
        assert "all drones are down" in (tmp_path / LOG).read_text()

    played(tmp_path, play)
    assert deeds(tmp_path) == [PICK, ("cf2", "pick_item", "cf2")]
    assert still_runs(tmp_path / "nowhere") is None


@pytest.mark.process
def test_a_gateway_that_cannot_begin_says_why(tmp_path: Path) -> None:
    """With the last line of its log, and where the rest is."""

    async def play(brain: Brain) -> None:
        (tmp_path / "world.jsonl").mkdir()
        with pytest.raises(BadInput, match=r"the gateway ended before it was ready: .*world.jsonl"):
            await brain.linked()

    played(tmp_path, play)


@pytest.mark.long
def test_a_gateway_that_hangs_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It says nothing any more: it is killed, and another one takes over the world."""
    monkeypatch.setattr(remote, "GATEWAY_TIMEOUT", 1.5)  # it says something each second

    async def play(brain: Brain) -> None:
        link = await brain.linked()
        await brain.flown(link, Task())
        hung = pid(tmp_path)
        assert hung is not None
        os.kill(hung, signal.SIGSTOP)
        monkeypatch.setattr(starting, "GATEWAY_TIMEOUT", 0.5)
        await brain.kernel.run(brain.lost)
        link = await brain.linked()
        assert pid(tmp_path) != hung
        assert (await brain.told(link.fleet_report())).drones["cf1"].carrying == "pills"

    played(tmp_path, play)


def test_a_folder_that_cannot_be_written_is_said_so(tmp_path: Path) -> None:
    """Before any process is started."""
    (tmp_path / "file").touch()

    async def play(brain: InsideBrain) -> None:
        with pytest.raises(BadInput, match=r"the gateway cannot be started: .*File exists"):
            await connect(tmp_path / "file", settings(), brain.kernel, 1)

    played_inside(tmp_path, play)


@pytest.mark.parametrize("arguments", [[], ["--help"]])
def test_starting_it_by_hand_is_answered_that_apps_do(
    arguments: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """And nothing is left in the folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "--help").mkdir()
    assert main(arguments) == 2
    assert "an app starts this by itself" in capsys.readouterr().err
    assert not list((tmp_path / "--help").iterdir())
