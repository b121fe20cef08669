"""A small share of `python -m tests.trials.strangers`: random apps under all weathers."""

from __future__ import annotations

import pytest

from pluto_fleet.simulation.body import Body
from pluto_fleet.simulation.drones import SimulatedNavigation
from plutoc_runtime.fleet.energy import CLIMB_SPEED
from tests.trials import strangers


def test_no_random_app_does_what_no_run_may_do(capsys: pytest.CaptureFixture[str]) -> None:
    """Two categories, actions of their own, links that are lost over a slow radio, and all the rest."""
    code = strangers.main(["--apps", "40", "--cases", "3", "--drawn"])
    said = capsys.readouterr().out
    assert code == 0, said
    assert "40 apps" in said and "0 apps with violations" in said


def test_a_mistake_in_the_world_is_found_by_them_and_shown_as_it_is(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A link that is lost before the take-off, and a drone that rises all the same: free in the air."""

    def lift_off(self: Body, now: float) -> None:
        self._charge = self._charge.changing(now, -1.0 / self.drone.category.flight_time)
        self._landed = False

    async def takeoff(self: SimulatedNavigation, drone: str, height: float) -> None:
        body, now = self.bodies[drone], self._kernel.now
        body.check(now)
        if body.landed:
            x, y, _ = body.location
            body.lift_off(now)
            await self._move(body, (x, y, height), CLIMB_SPEED, "to take off")

    monkeypatch.setattr(Body, "lift_off", lift_off)
    monkeypatch.setattr(SimulatedNavigation, "takeoff", takeoff)
    assert strangers.main(["--apps", "4", "--cases", "4", "--drawn"]) == 1
    said = capsys.readouterr().out
    shown = [part.split("Save that")[0] for part in said.split("--- app")[1:]]
    assert shown
    assert {part.count("is free in the air") >= 2 for part in shown} == {True}, said
