"""A drone that hovers is asked, and set, through its gateway: what `context.live` stands on."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.time.kernel import FLEET
from tests.library.gateway.flights import Field, Task
from tests.library.gateway.processes import InsideBrain, played_inside


def test_a_drone_behind_a_socket_keeps_what_it_is_set_to(tmp_path: Path) -> None:
    """While it hovers for an action of the app's own; a drone on the ground refuses."""

    async def play(brain: InsideBrain) -> None:
        link = await brain.linked()
        await brain.flown(link, Task(action=None))
        hover = brain.kernel.spawn(link.hold("cf1"), FLEET, "an action")
        await brain.told(link.write("cf1", "gripper.closed", 1.0))
        assert await brain.told(link.read("cf1", "gripper.closed")) == 1.0
        assert not hover.is_set
        with pytest.raises(FlightFailed, match="it must take off first") as refused:
            await brain.told(link.read("cf2", "gripper.closed"))
        assert refused.value.failure is Failure.REFUSED
        hover.cancel()

    played_inside(tmp_path, play)


def test_a_client_that_is_cut_off_hears_no_answer() -> None:
    """Neither what it is nor that it failed: silence is all that a lost link gives."""
    field = Field()
    old = field.gateway.link(1)
    old.fly(Task(action=None), lambda _: None)
    field.advance(100)
    asked = field.kernel.spawn(old.read("cf1", "range.front"), FLEET, "asked in time")
    field.advance(0)
    field.gateway.link(2)
    late = field.kernel.spawn(old.write("cf1", "range.front", 1.0), FLEET, "asked too late")
    field.advance(100)
    assert asked.is_set
    assert not late.is_set
    assert field.navigation.bodies["cf1"].settings == {}
