"""Whether a vehicle does what it was told, by its modes."""

from __future__ import annotations

from pluto_fleet.mavlink.makes import ArduPilot
from pluto_fleet.mavlink.obedience import Change, Obedience

MODES = ArduPilot.modes
GUIDED, RTL, LAND = 4, 6, 9


def test_one_that_is_found_in_the_air_may_have_been_told_to_fly_and_is_let_land() -> None:
    assert Obedience().look(GUIDED, MODES, 100.0) is Change.NONE
    for mode in (RTL, LAND):
        assert Obedience().look(mode, MODES, 100.0) is Change.LEAVES


def test_a_new_mode_has_its_time_unless_it_was_in_it_already() -> None:
    told = Obedience()
    told.tell("land", 100.0)
    assert told.look(GUIDED, MODES, 101.0) is Change.NONE
    assert told.look(GUIDED, MODES, 103.0) is Change.LEAVES
    told.tell("go", 100.0, obeys=True)
    assert told.look(RTL, MODES, 100.1) is Change.LEAVES


def test_it_is_given_back_once_it_stays_in_a_mode_in_which_it_takes_orders() -> None:
    pilot = Obedience(by_itself="a pilot flies it")
    looks = [pilot.look(mode, MODES, at) for at, mode in enumerate((GUIDED, RTL, GUIDED, GUIDED))]
    assert looks == [Change.NONE] * 4
    assert pilot.look(GUIDED, MODES, 5.0) is Change.IS_BACK
    assert not pilot.by_itself
