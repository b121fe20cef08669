"""Simulated drones that nothing charges at home: a flight goes with them as a simulation says."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest

from pluto_fleet.files.stand_ins import CRTP, StandIns
from pluto_fleet.flight.config import FlightSetup
from pluto_fleet.shared.domain.model import Category
from tests.kit import apps
from tests.kit.command import python
from tests.kit.living import Living, enterable

UNCHARGED = "what is left in its battery is too little, and nothing charges it at home"
WEAK = Category(name="scout", flight_time=100.0, reserve=0.2)
ALONE = replace(apps.fleet((1.0, 0.5, 0.0)), charges_at_home=False)
TRIP = """
[[mission]]
name = "{}"
{}
[[mission.trip]]
action = "measure"
parameters = {{ quantity = "pm10" }}
target = [9, 5, 1.5]
"""
MISSIONS = TRIP.format("There", "") + TRIP.format("Again", 'after = "There"')
FLEET = """
[map]
size = [18.0, 12.0]
[fleet]
after_trip = "home"
charges_at_home = false
[motion]
drain = "500 %"
[[drone]]
id = "cf1"
category = "sampler"
home = [2, 0.8]
"""


@pytest.mark.long
@pytest.mark.process
def test_a_flight_of_simulated_drones_ends_as_its_simulation(tmp_path: Path) -> None:
    """Missions that no battery is left for fail, and none is waited for that will never be full."""
    package = apps.compiled("pm10", tmp_path)
    (tmp_path / "m.toml").write_text(MISSIONS)
    (tmp_path / "f.toml").write_text(FLEET)
    files = ("m.toml", "--fleet", "f.toml")
    flags = ("--sim", "--speed", "60", "--journal", "J")
    for words in ("simulate", *files), ("fly", *files, *flags):
        ran = python("-m", "pm10", *words, cwd=tmp_path, PYTHONPATH=str(package / "src"))
        assert ran.code == 1, ran.err
        assert f"Again: FAILED: no drone of the fleet can fly trip 1: {UNCHARGED}\n" in ran.out


def test_no_level_rises_in_a_flight_also_after_the_app_has_died() -> None:
    missions = [apps.mission(name, apps.trip("1", 6)) for name in "abcd"]
    living = Living(replace(enterable(), categories=(WEAK,)), *missions, on=ALONE)
    living.crash(20.0)
    status = living.run()
    assert status[0] == "COMPLETED" and status[-1] == "FAILED"
    assert UNCHARGED in str(living.named("mission.ended")[-1]["reason"])
    told = [event.get("battery") for event in living.events]
    levels = [level for level in told if isinstance(level, float)]
    assert len(levels) > 3 and all(a >= b for a, b in pairwise(levels))


@pytest.mark.parametrize(
    ("sim", "crtp", "charges"), [(True, False, False), (False, True, False), (False, False, True)]
)
def test_only_a_real_drone_has_its_say_of_its_battery(sim: bool, crtp: bool, charges: bool) -> None:
    flight = FlightSetup(
        app=enterable(),
        journal=Path("J"),
        missions=(),
        fleet=ALONE,
        speed=1.0,
        seed=0,
        faults=apps.NO_FAULTS,
        sim=sim,
        stand_ins=StandIns(CRTP, 1) if crtp else None,
    )
    assert flight.charges is charges
