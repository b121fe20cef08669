"""How drones are at a Start: as they were heard of last, charged since, or as it must be supposed."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import pytest

from pluto_fleet.gateway.sightings import Sighting
from pluto_fleet.journal.standing import Standing
from pluto_fleet.station.preflight.question import Present, at_rest
from pluto_fleet.station.wait_reasons import level_after, ready_in, to_fly
from tests.library.files.an_app import APP
from tests.library.station.preflight.asking import FLEET

ENTRY = FLEET.drones[0]
KIND = next(one for one in APP.categories if one.name == ENTRY.category)
NOW = 1_000.0


def heard(
    at: tuple[float, float, float] = ENTRY.home, *, landed: bool = True, why: str = ""
) -> Sighting:
    return Sighting(at=at, battery=0.4, landed=landed, when=NOW - 60.0, why=why)


def present(
    seen: Sighting | None,
    records: Standing | None = None,
    *,
    simulated: bool = True,
    speed: float = 1.0,
) -> Present:
    return at_rest(
        ENTRY, KIND, seen, records or Standing(), now=NOW, simulated=simulated, speed=speed
    )


def test_a_drone_has_charged_since_it_was_heard_of_in_its_dock_and_nowhere_else() -> None:
    docked, fast = present(heard()), present(heard(), speed=2.0)
    assert docked.battery == pytest.approx(level_after(KIND, 0.4, 60.0, ENTRY.home, ENTRY.home))
    assert 0.4 < docked.battery < fast.battery
    assert docked.assumed is None
    assert present(heard((5.0, 5.0, 0.0))).battery == 0.4


def test_what_is_supposed_of_a_real_drone_is_said() -> None:
    before = present(heard(), simulated=False)
    assert before.assumed is not None
    assert before.assumed["text"].startswith("heard of 1 min ago, at 40 %: supposed to be at ")
    never = present(None, simulated=False)
    assert never.assumed is not None
    assert (never.known, never.battery) == (False, 1.0)
    assert "supposed to be charged, in its dock" in never.assumed["text"]
    assert present(None).assumed is None


def test_lost_retired_and_hovering_drones_fly_nothing_and_say_why() -> None:
    lost = Standing()
    retired = Standing()
    mended = Standing()
    lost.lose(ENTRY.id, "it fell", None)
    retired.with_drone(ENTRY.id, retired=True)
    mended.with_drone(ENTRY.id, mended=True)
    found = [
        present(heard(), lost),
        present(heard(), retired),
        present(heard(why="no link")),
        present(heard(landed=False)),
    ]
    assert [one.out["text"] if one.out else "" for one in found] == [
        "lost: it fell",
        "retired",
        "no link",
        "it was in the air when it was last heard of: go and look",
    ]
    back = present(heard(), mended)
    assert (back.out, back.known, back.at) == (None, False, ENTRY.home)


def test_a_battery_is_ready_when_it_has_charged_up_to_what_it_needs() -> None:
    wanted = to_fly(KIND)
    assert wanted > KIND.reserve
    assert ready_in(KIND, 0.9, wanted, docked=False) == 0.0
    assert ready_in(KIND, 0.1, wanted, docked=False) is None
    assert ready_in(KIND, 0.1, 1.01, docked=True) is None
    uncharged = replace(KIND, charge_time=inf)  # in a fleet that says so
    assert ready_in(uncharged, 0.1, wanted, docked=True) is None
    assert level_after(uncharged, 0.1, 600.0, ENTRY.home, ENTRY.home) == 0.1
    seconds = ready_in(KIND, 0.1, wanted, docked=True)
    assert seconds is not None
    assert level_after(KIND, 0.1, seconds, ENTRY.home, ENTRY.home) == pytest.approx(wanted)
