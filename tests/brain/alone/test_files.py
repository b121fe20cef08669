"""The small reader takes what the full one takes, and makes the same of it."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from pluto_fleet.files import fleet as full_fleet
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.alone import simulate as alone
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.fleet_data import DroneData, FleetData
from tests.kit.apps import EXAMPLES
from tests.library.files.an_app import APP, PLAIN
from tests.library.files.test_fleet import FULL

if TYPE_CHECKING:
    from pluto_fleet.app import App
    from pluto_fleet.shared.domain.model import Mission
    from tests.kit.apps import Example


OF_THE_LIBRARY = {"night_round"}
"""The examples with promises, areas or lists, of which a package alone says what to install."""


def told(fleet: FleetData) -> object:
    """Return what the brain knows of a fleet."""
    drones = [
        tuple(getattr(drone, one.name) for one in fields(DroneData)) for drone in fleet.drones
    ]
    behaviour = fleet.after_trip, fleet.max_airborne, fleet.motion
    return fleet.airspace, drones, behaviour, fleet.world


def plain(missions: list[Mission[Any]]) -> str:
    """Return all that missions hold."""
    return repr(missions)


def test_the_examples_files_are_read_alike(example: Example) -> None:
    """Both files of each."""
    folder = EXAMPLES / example.name
    fleet = files.load_fleet(folder / "fleet.toml", example.app)
    assert told(fleet) == told(example.fleet)
    path = folder / "missions.toml"
    if example.name in OF_THE_LIBRARY:
        with pytest.raises(BadInput, match="needs pluto-fleet, the library that flies"):
            files.load_missions(path, example.app, fleet.airspace)
        return
    missions = files.load_missions(path, example.app, fleet.airspace)
    assert plain(missions) == plain(list(example.missions))


def test_everything_that_a_fleet_file_may_hold_is_read_alike(tmp_path: Path) -> None:
    """What only real flights need is passed over, of any type."""
    path = tmp_path / "fleet.toml"
    path.write_text(FULL)
    fleet = files.load_fleet(path, APP)
    assert told(fleet) == told(full_fleet.load_fleet(path, APP))
    path.write_text(FULL.replace('"40 cm"', "-3").replace('"lab.mocap:Mocap"', "7"))
    assert told(files.load_fleet(path, APP)) == told(fleet)


@pytest.mark.parametrize("app", [APP, PLAIN], ids=["APP", "PLAIN"])
def test_the_fleet_without_a_file_is_the_same(app: App) -> None:
    """Five drones on a plain."""
    assert told(alone.default_fleet(app)) == told(full_fleet.default_fleet(app))
