"""What the gateway writes down of its drones, for who looks after it was killed."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.gateway.sightings import SEEN, Sightings, sightings_in
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from tests.library.gateway.flights import THERE, Field


def watched(folder: Path) -> tuple[Field, Sightings]:
    """Return drones at home, and who writes down how they are; no look is taken by itself."""
    field = Field()
    seen = Sightings(folder / SEEN, field.navigation.telemetry, down=field.navigation.down)
    field.options["leaving"] = seen.leaving
    field.another()
    return field, seen


def test_a_drone_is_said_to_be_in_the_air_before_it_leaves_the_ground(tmp_path: Path) -> None:
    field, seen = watched(tmp_path)
    seen.keep()
    assert sightings_in(tmp_path)["cf1"].landed
    link = field.link(1)
    field.advance(0)
    field.kernel.spawn(link.goes("cf1", THERE), 0, "cf1 rises")
    field.advance(0)
    assert field.navigation.telemetry["cf1"].location[2] == 0
    for _ in range(2):
        assert not sightings_in(tmp_path)["cf1"].landed
        assert sightings_in(tmp_path)["cf2"].landed
        seen.keep()
    field.advance(5)
    assert field.navigation.telemetry["cf1"].location[2] > 0.9
    seen.keep()
    assert not sightings_in(tmp_path)["cf1"].landed


def test_a_take_off_that_fails_leaves_the_drone_on_the_ground(tmp_path: Path) -> None:
    _, seen = watched(tmp_path)
    with pytest.raises(FlightFailed), seen.leaving("cf1"):
        assert not sightings_in(tmp_path)["cf1"].landed
        raise FlightFailed(Failure.REFUSED, "cf1 is not ready")
    seen.keep()
    assert sightings_in(tmp_path)["cf1"].landed


def test_why_a_drone_takes_no_commands_is_written_down_and_forgotten_once_it_takes_them(
    tmp_path: Path,
) -> None:
    field, seen = watched(tmp_path)
    field.navigation.strike("cf1", Failure.CRASH)
    field.navigation.strike("cf2", Failure.LINK, "cf2 lost its link")
    seen.keep()
    found = sightings_in(tmp_path)
    assert found["cf1"].why.startswith("cf1 crashed at")
    assert found["cf1"].has_fallen
    assert (found["cf2"].why, found["cf2"].has_fallen) == ("cf2 lost its link", False)
    field.navigation.mended("cf1")
    seen.keep()
    mended = sightings_in(tmp_path)["cf1"]
    assert (mended.why, mended.has_fallen) == ("", False)
