"""Motors are cut by a command of its own, past the brain, and do not turn before they may."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.gateway.ledger import Ledger
from pluto_fleet.gateway.process import LEDGER
from pluto_fleet.jobs.controls import Cut
from pluto_fleet.jobs.reports import Down
from pluto_fleet.process.ipc import line
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.simulation.drones import CARRIES_OUT
from tests.library.gateway.flights import THERE, Field, Task
from tests.library.gateway.processes import InsideBrain, played_inside
from tests.library.simulation.flights import failure, fly


def cut(field: Field, drone: str = "cf1") -> str:
    return fly(field.kernel, field.gateway.cut_motors(drone))


def test_a_drone_whose_motors_are_cut_falls_and_its_flight_fails() -> None:
    """At once, as a crash; another drone notices nothing."""
    field, heard, other = Field(), list[object](), list[object]()
    link = field.link(1)
    link.fly(Task(), heard.append)
    link.fly(Task(id="North field/B/0/1", drone="cf2", action="measure", item=None), other.append)
    field.advance(10)
    assert cut(field) == ""
    field.advance(0)
    (error,) = heard
    assert isinstance(error, FlightFailed)
    assert (error.failure, str(error)) == (Failure.CRASH, "cf1's motors were cut")
    body = field.navigation.bodies["cf1"]
    assert body.landed
    assert body.location[2] == 0.0
    field.advance(100)
    assert isinstance(other[0], float)


def test_nothing_turns_its_motors_on_before_a_person_has_looked_after_it() -> None:
    """Neither a flight nor a command, nor a Stop that brings all home; then it flies again."""
    field, heard = Field(), list[object]()
    link = field.link(1)
    cut(field)
    link.fly(Task(), heard.append)
    field.advance(1)
    assert isinstance(heard[0], FlightFailed)
    assert str(heard[0]) == "cf1's motors were cut"
    for command in (link.home("cf1"), link.land("cf1"), link.hold("cf1")):
        assert failure(field.kernel, command).failure is Failure.CRASH
    assert fly(field.kernel, link.recover("cf1")) is False
    fly(field.kernel, link.bring_down(Down.HOME))
    assert field.navigation.flown("cf1") == 0.0
    link = field.link(2)
    link.mended("cf1")
    assert fly(field.kernel, link.recover("cf1")) is True
    link.fly(Task(id="North field/A/0/2"), heard.append)
    field.advance(100)
    assert heard[1] is None


def test_one_whose_motors_are_cut_on_its_way_home_is_lost_at_once() -> None:
    """It is not waited for until it was carried home: it is for a person to say that it is well."""
    field = Field()
    link = field.link(1)
    link.fly(Task(action=None), lambda _: None)
    field.advance(100)
    recovery = field.kernel.spawn(link.recover("cf1"), FLEET, "a recovery")
    field.advance(1)
    cut(field)
    field.advance(1)
    assert recovery.is_set
    assert recovery.result() is False


def test_one_whose_motors_are_cut_is_told_nothing_when_its_flight_is_broken_off(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """To hover is a command too, and would turn its motors on."""
    field, told = Field(), list[str]()
    monkeypatch.setattr(type(field.navigation), "break_off", lambda _, drone: told.append(drone))
    link = field.link(1)
    cut(field, "cf1")
    for drone in ("cf1", "cf2"):
        link.break_off(drone)
    assert told == ["cf2"]


class Kept(Field):
    """A field whose gateways keep their ledger on the disk."""

    def __init__(self, folder: Path) -> None:
        self.file = folder / LEDGER
        super().__init__(ledger=Ledger(self.file))

    def is_killed(self) -> None:
        """Kill the gateway and begin another, while cf1 is switched off and on again."""
        self.gateway.crash()
        self.ledger.close()
        self.navigation.mended("cf1")
        self.ledger = Ledger(self.file)
        self.another()

    def problems(self, epoch: int) -> tuple[str, ...]:
        return fly(self.kernel, self.gateway.link(epoch).fleet_report()).drones["cf1"].problems


def test_another_gateway_knows_whose_motors_were_cut(tmp_path: Path) -> None:
    """The drone itself may have forgotten it: who looks after it says so, once and for all."""
    field, heard = Kept(tmp_path), list[object]()
    cut(field)
    field.is_killed()
    assert field.problems(1) == ("cf1's motors were cut",)
    link = field.link(2)
    fly(field.kernel, link.fleet_report())
    for command in (link.home("cf1"), link.land("cf1")):
        assert failure(field.kernel, command).failure is Failure.CRASH
    assert fly(field.kernel, link.recover("cf1")) is False
    assert fly(field.kernel, link.recover("cf2")) is True
    link.mended("cf1")
    field.is_killed()
    assert field.problems(3) == ()
    field.link(4).fly(Task(), heard.append)
    field.advance(100)
    assert field.navigation.flown("cf1") > 0
    field.kernel.close()


def test_it_is_on_record_before_it_is_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A process may be killed at any time; what then flies on is landed, and stays down."""
    field = Kept(tmp_path)
    on_record: list[list[str]] = []

    async def killed(_: object, drone: str) -> None:
        there = Ledger(field.file)
        on_record.append(there.cut)
        there.close()

    link = field.link(1)
    fly(field.kernel, link.goes("cf1", THERE))
    with monkeypatch.context() as patch:
        patch.setitem(CARRIES_OUT, Cut, killed)
        cut(field)
    assert on_record == [["cf1"]]
    field.is_killed()
    assert field.problems(2) == ()
    link = field.link(3)
    fly(field.kernel, link.bring_down(Down.LAND))
    assert field.navigation.bodies["cf1"].landed
    assert field.problems(4) == ("cf1's motors were cut",)
    field.kernel.close()


def test_who_could_not_be_told_is_as_before(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A drone whose motors were cut before is not taken for well because it is out of reach now."""

    async def unreachable(_: object, drone: str) -> None:
        raise FlightFailed(Failure.LINK, f"{drone} cannot be reached")

    field = Kept(tmp_path)
    cut(field, "cf1")
    monkeypatch.setitem(CARRIES_OUT, Cut, unreachable)
    assert cut(field, "cf1") == "cf1 cannot be reached"
    assert cut(field, "cf2") == "cf2 cannot be reached"
    for epoch in (1, 2):
        assert field.problems(epoch) == ("cf1's motors were cut",)
        link = field.link(epoch)
        fly(field.kernel, link.fleet_report())
        assert fly(field.kernel, link.recover("cf2")) is True
        field.is_killed()
    field.kernel.close()


def test_one_that_flies_in_spite_of_a_cut_is_landed_though_it_could_not_be_told_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The gateway before died between its record and the cut: only what was done here keeps it down."""

    async def killed(_: object, drone: str) -> None:
        """Nothing reaches the drone."""

    async def unreachable(_: object, drone: str) -> None:
        raise FlightFailed(Failure.LINK, f"{drone} cannot be reached")

    field = Kept(tmp_path)
    fly(field.kernel, field.link(1).goes("cf1", THERE))
    with monkeypatch.context() as patch:
        patch.setitem(CARRIES_OUT, Cut, killed)
        cut(field)
        field.is_killed()
        patch.setitem(CARRIES_OUT, Cut, unreachable)
        assert cut(field) == "cf1 cannot be reached"
    assert field.problems(2) == ()
    fly(field.kernel, field.link(3).bring_down(Down.LAND))
    assert field.navigation.bodies["cf1"].landed
    field.kernel.close()


def test_a_full_disk_keeps_no_motors_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a person wants off is off."""

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    field = Field()
    monkeypatch.setattr(type(field.ledger), "write_cut", full)
    monkeypatch.setattr(type(field.ledger), "make_sure", full)
    assert cut(field) == ""
    link = field.link(1)
    assert str(failure(field.kernel, link.home("cf1"))) == "cf1's motors were cut"
    link.mended("cf1")
    assert fly(field.kernel, link.recover("cf1")) is True


async def cuts(brain: InsideBrain, **which: object) -> str:
    """Have motors cut by a program of one's own, and return what it is told."""
    [answer] = await brain.tells(line({"do": "cut-motors", **which}))
    return str(answer["said"])


def test_motors_are_cut_while_the_brain_hangs(tmp_path: Path) -> None:
    """Every program that may open the socket may do that; a brain that comes back hears of it."""

    async def play(brain: InsideBrain) -> None:
        link, heard = await brain.linked(), list[object]()
        to_and_fro = Task(stops=(THERE, (1.0, 1.0, 1.2)) * 10)  # until long after they are cut
        brain.kernel.post(link.fly, to_and_fro, heard.append)
        await brain.until(lambda: link.telemetry("cf1").location[0] > 2)
        assert await cuts(brain, drone="cf1") == "the motors of cf1 are cut"
        await brain.until(lambda: bool(heard))
        assert str(heard[0]) == "cf1's motors were cut"
        assert not brain.lost.is_set
        assert await cuts(brain, all=True) == "the motors of cf1, cf2 are cut"
        said = await cuts(brain, drone="cf9")
        assert said == 'no drone "cf9" is in the fleet; there are: "cf1", "cf2"'
        assert not await brain.told(link.recover("cf1"))
        brain.kernel.post(link.mended, "cf1")
        assert await brain.told(link.recover("cf1"))

    played_inside(tmp_path, play)
