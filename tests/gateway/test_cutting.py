"""Motors are cut by a command of its own, past the brain, and turn for nobody before they may."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from plutoc_runtime.errors import BadInput, Failure, FlightFailed
from plutoc_runtime.gateway.starting import cut_directly
from plutoc_runtime.kernel import FLEET
from plutoc_runtime.standing import Down
from tests.gateway.flights import THERE, Field, Task
from tests.gateway.processes import Brain, played
from tests.runtime.simulation.flights import failure, fly


def cut(field: Field, drone: str = "cf1") -> str:
    """Cut a drone's motors, and return why that could not be done."""
    return fly(field.virtual, field.gateway.cut_motors(drone))


def test_a_drone_whose_motors_are_cut_falls_and_its_flight_fails() -> None:
    """At once, as a crash; another drone notices nothing."""
    field, heard, other = Field(), list[object](), list[object]()
    link = field.gateway.link(1)
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


def test_what_hovers_for_an_action_fails_as_well() -> None:
    """The brain hears it from the command that is under way."""
    field = Field()
    link = field.gateway.link(1)
    link.fly(Task(action=None), lambda _: None)
    field.advance(100)
    hover = field.kernel.spawn(link.hold("cf1"), FLEET, "an action")
    hover.watch(lambda _: None)
    field.advance(1)
    cut(field)
    field.advance(0)
    assert str(hover.error) == "cf1's motors were cut"


def test_nothing_turns_its_motors_on_before_somebody_has_looked_after_it() -> None:
    """Neither a flight nor a command, nor a Stop that brings all home; then it flies again."""
    field, heard = Field(), list[object]()
    link = field.gateway.link(1)
    cut(field)
    link.fly(Task(), heard.append)
    field.advance(1)
    assert isinstance(heard[0], FlightFailed)
    assert str(heard[0]) == "cf1's motors were cut"
    for command in (link.takeoff("cf1", 1.2), link.go_to("cf1", THERE), link.land("cf1")):
        assert failure(field.virtual, command).failure is Failure.CRASH
    assert fly(field.virtual, link.recover("cf1")) is False
    fly(field.virtual, link.bring_down(Down.HOME))
    assert field.navigation.flown("cf1") == 0.0
    link = field.gateway.link(2)
    link.mended("cf1")
    assert fly(field.virtual, link.recover("cf1")) is True
    link.fly(Task(id="North field/A/0/2"), heard.append)
    field.advance(100)
    assert heard[1] is None


def test_a_drone_that_cannot_be_told_is_not_taken_for_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is said why; when it can be reached again, it shall come home."""

    async def unreachable(_: object, drone: str) -> None:
        raise FlightFailed(Failure.LINK, f"{drone} cannot be reached")

    field = Field()
    monkeypatch.setattr(type(field.navigation), "cut", unreachable)
    assert cut(field) == "cf1 cannot be reached"
    assert fly(field.virtual, field.gateway.link(1).recover("cf1")) is True


def test_motors_are_cut_while_the_brain_hangs(tmp_path: Path) -> None:
    """Whoever may open the socket may do that; a brain that comes back hears of it."""

    async def play(brain: Brain) -> None:
        link, heard = await brain.linked(), list[object]()
        brain.kernel.post(link.fly, Task(), heard.append)
        await brain.until(lambda: link.telemetry("cf1").location[0] > 2)
        said = await asyncio.to_thread(cut_directly, tmp_path, "cf1", 5)
        assert said == "the motors of cf1 are cut"
        await brain.until(lambda: bool(heard))
        assert str(heard[0]) == "cf1's motors were cut"
        assert not brain.lost.is_set
        said = await asyncio.to_thread(cut_directly, tmp_path, None, 5)
        assert said == "the motors of cf1, cf2 are cut"
        with pytest.raises(
            BadInput, match='no drone "cf9" is in the fleet; there are: "cf1", "cf2"'
        ):
            await asyncio.to_thread(cut_directly, tmp_path, "cf9", 5)
        assert not await brain.told(link.recover("cf1"))
        brain.kernel.post(link.mended, "cf1")
        assert await brain.told(link.recover("cf1"))

    played(tmp_path, play)
