"""The simulated world on the disk: read back, it is where it has come to meanwhile."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path

import pytest

from pluto_fleet.jobs.controls import GoTo, Land, TakeOff
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.motion import CRAZYFLIE, varied, varies
from pluto_fleet.simulation.world_store import (
    DEEDS,
    DRONES,
    Moment,
    WorldStore,
    this_moment,
    time_in_world,
)
from tests.library.gateway.flights import PILLS, SCOUT, THERE, Field, Task
from tests.library.simulation.flights import failure, fly


class Kept(Field):
    """A field that is kept in a folder; the wall's clock goes with its own."""

    def __init__(
        self,
        folder: Path,
        wall: float = 1000.0,
        faults: Faults | None = None,
        category: Category = SCOUT,
    ) -> None:
        super().__init__(faults=faults, category=category)
        kernel = self.kernel
        self._begun = wall
        self.keeper = WorldStore(folder, kernel.time, 1.0, self.moment)
        self.navigation.record = self.keeper.record
        self.keeper.take_over(self.navigation.bodies)

    def wall(self) -> float:
        return self._begun + self.kernel.now

    def moment(self) -> Moment:
        """Return a moment of a machine that cannot say how long it has been on."""
        return Moment(wall=self.wall(), boot="", up=0.0)

    def later(self, folder: Path, seconds: float, faults: Faults | None = None) -> Kept:
        """Let the process be killed, and return the world of another that begins later."""
        self.keeper.settled()
        return Kept(folder, self.wall() + seconds, faults, self.drones[0].category)


def test_a_drone_flies_on_while_it_is_not_looked_at(tmp_path: Path) -> None:
    """To the end of its leg, and its battery drains; there it hovers, and can be flown on."""
    field = Kept(tmp_path)
    field.link(1).fly(Task(), lambda _: None)
    field.advance(6)
    field = field.later(tmp_path, 3)
    telemetry = field.navigation.telemetry["cf1"]
    assert telemetry.location == pytest.approx((2.5, 3, 1.2))
    assert telemetry.battery_level == pytest.approx(1 - 9 / 420)
    field = field.later(tmp_path, 60)
    telemetry = field.navigation.telemetry["cf1"]
    assert telemetry.location == pytest.approx(THERE)
    assert not telemetry.landed
    fly(field.kernel, field.navigation.do("cf1", Land()))
    assert field.later(tmp_path, 5).navigation.telemetry["cf1"].landed


def test_time_goes_on_in_a_world_whose_process_has_ended(tmp_path: Path) -> None:
    """So what moves in it is where it has got to, and not back where it was at first."""
    now = this_moment()
    assert time_in_world(tmp_path, 1.0, now) == 0.0
    field = Kept(tmp_path)
    field.advance(6)
    later = replace(field.moment(), wall=field.wall() + 3.0)
    assert time_in_world(tmp_path, 1.0, later) == pytest.approx(9.0)


def test_what_was_done_and_is_aboard_is_remembered(tmp_path: Path) -> None:
    """Also where the drones' file is older than the deeds: the deed comes first."""
    field = Kept(tmp_path)
    field.link(1).fly(Task(), lambda _: None)
    field.advance(15)
    field.keeper.settled()
    before = (tmp_path / DRONES).read_bytes()
    field.advance(10)
    (tmp_path / DRONES).write_bytes(before)
    field = Kept(tmp_path, 1025.0)
    assert field.navigation.carrying("cf1") == PILLS
    report = fly(field.kernel, field.navigation.drone_report("cf1"))
    assert report.done == {Task().id: None}
    deeds = [json.loads(line) for line in (tmp_path / DEEDS).read_text().splitlines()]
    (deed,) = deeds
    assert [deed[key] for key in ("time", "drone", "action", "item", "job", "boot")] == [
        pytest.approx(1016),
        "cf1",
        "pick_item",
        "pills",
        Task().id,
        0,
    ]


def test_a_line_that_was_never_finished_was_never_done(tmp_path: Path) -> None:
    """The next deed is written over it."""
    field = Kept(tmp_path)
    field.link(1).fly(Task(), lambda _: None)
    field.advance(15)
    field.keeper.settled()
    with (tmp_path / DEEDS).open("ab") as file:
        file.write(b'{"drone": "cf1", "act')
    field = Kept(tmp_path, 1020.0)
    assert field.navigation.carrying("cf1") is None
    field.link(1).fly(Task(), lambda _: None)
    field.advance(20)
    assert json.loads((tmp_path / DEEDS).read_text())["job"] == Task().id


def test_what_cannot_be_written_down_is_not_done(tmp_path: Path) -> None:
    """On a full disk an action fails; the world goes on."""
    field, heard = Kept(tmp_path), list[object]()
    real = os.pwrite
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "pwrite", lambda file, text, at: real(file, text[:5], at))
        field.link(1).fly(Task(), heard.append)
        field.advance(20)
    (error,) = heard
    assert isinstance(error, FlightFailed)
    assert error.failure is Failure.ACTION
    assert "the simulated world cannot be written down" in str(error)
    assert (tmp_path / DEEDS).read_bytes() == b""
    assert field.navigation.carrying("cf1") is None


@pytest.mark.parametrize("is_killed", [False, True])
def test_chance_does_not_depend_on_the_process(tmp_path: Path, is_killed: bool) -> None:
    """A leg takes as long in a process that was started on the way."""
    field = Kept(tmp_path, category=replace(SCOUT, motion=CRAZYFLIE))
    field.navigation.begins("cf1", Task().id, 15.0)
    fly(field.kernel, field.navigation.do("cf1", TakeOff(1.2)))
    if is_killed:
        field = field.later(tmp_path, 60)
    begun = field.kernel.now
    fly(field.kernel, field.navigation.do("cf1", GoTo(THERE)))
    expected = varied(CRAZYFLIE, 1).flies(5.0, SCOUT.speed)
    factor = varies(CRAZYFLIE.spread, f"1/{Task().id}/4.00/5.00/1.20")
    assert field.kernel.now - begun == pytest.approx(factor * expected)


@pytest.mark.parametrize("what", [Failure.CRASH, Failure.LINK, Failure.BATTERY])
def test_mishaps_stay_what_they_were(tmp_path: Path, what: Failure) -> None:
    """A drone that takes no commands takes none from another process either."""
    field = Kept(tmp_path)
    fly(field.kernel, field.navigation.do("cf1", TakeOff(1.2)))
    field.navigation.strike("cf1", what)
    field = field.later(tmp_path, 10)
    assert field.navigation.telemetry["cf1"].landed
    error = failure(field.kernel, field.navigation.do("cf1", TakeOff(1.2)))
    assert error.failure is what
    assert fly(field.kernel, field.gateway.recover("cf1")) is (what is not Failure.CRASH)


def test_how_long_ago_it_was_depends_on_no_clock_that_can_be_set() -> None:
    """As long as the machine was not started again; then there is only the clock on the wall."""
    was = Moment(wall=1000.0, boot="a", up=50.0)
    assert Moment(wall=9000.0, boot="a", up=53.0).since(was) == 3
    assert Moment(wall=500.0, boot="a", up=53.0).since(was) == 3
    assert Moment(wall=1100.0, boot="b", up=4.0).since(was) == 100
    assert Moment(wall=900.0, boot="b", up=4.0).since(was) == 0
    assert Moment(wall=1001.0, boot="", up=0.0).since(replace(was, boot="")) == 1
    before = this_moment()
    assert this_moment().since(before) >= 0
    assert before.since(this_moment()) == 0
