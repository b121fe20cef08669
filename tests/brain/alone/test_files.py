"""The small reader takes what the full one takes, and makes the same of it."""

from __future__ import annotations

import tempfile
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files import fleet as full_fleet
from pluto_fleet.files import missions as full_missions
from pluto_fleet.files.fleet_text import fleet_text
from pluto_fleet.files.missions_text import missions_text
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.alone import simulate as alone
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.fleet_data import DroneData, Feature, FleetData, Source, WorldData
from pluto_fleet.shared.domain.model import AfterTrip
from pluto_fleet.shared.domain.motion import CRAZYFLIE, STRAIGHT
from pluto_fleet.trials.explore import random_missions
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


places = st.floats(0.0, 19.0).map(lambda x: round(x, 3))
spots = st.tuples(places, places)
names = st.text("abcdefü -_", min_size=1, max_size=8).filter(
    lambda name: name == name.strip() != ""
)
worlds = st.builds(
    WorldData,
    features=st.lists(
        st.builds(Feature, kind=names, at=spots, radius=st.floats(0.01, 9.0)), max_size=3
    ).map(tuple),
    sources=st.lists(
        st.builds(
            Source, quantity=names, at=spots, peak=st.floats(-9, 9), radius=st.floats(0.01, 9.0)
        ),
        max_size=3,
    ).map(tuple),
    background=st.dictionaries(names, st.floats(-1e6, 1e6), max_size=2),
)


MOTIONS = (
    STRAIGHT,
    CRAZYFLIE,
    replace(CRAZYFLIE, pace=1.25, drain=0.9),
    replace(STRAIGHT, landing=2.0),
)


@st.composite
def fleets(draw: st.DrawFn) -> full_fleet.FleetFile:
    """Return a fleet whose drones stand apart."""
    homes = draw(
        st.lists(
            st.tuples(st.integers(0, 19), st.integers(0, 19)), min_size=1, max_size=6, unique=True
        )
    )
    return full_fleet.FleetFile(
        airspace=Airspace(
            size=(20.0, draw(st.floats(20.0, 99.0))),
            cruise_height=draw(st.floats(0.1, 3.0)),
            ceiling=draw(st.floats(3.0, 99.0)),
        ),
        drones=tuple(
            full_fleet.DroneEntry(
                id=f"{place} {draw(names)}",
                category=draw(st.sampled_from([one.name for one in APP.categories])),
                home=(float(x), float(y), draw(st.sampled_from([0.0, 0.25]))),
            )
            for place, (x, y) in enumerate(homes)
        ),
        after_trip=draw(st.sampled_from(AfterTrip)),
        max_airborne=draw(st.none() | st.integers(1, 9)),
        motion=draw(st.sampled_from(MOTIONS)),
        world=draw(worlds),
    )


@given(fleets(), st.integers(0, 10**6))
def test_plans_at_random_are_read_alike(fleet: full_fleet.FleetFile, seed: int) -> None:
    """What the full reader makes of them, the small one makes, too."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "fleet.toml")
        path.write_text(fleet_text(fleet), "utf-8")
        assert told(files.load_fleet(path, APP)) == told(full_fleet.load_fleet(path, APP))
        drawn = random_missions(APP, fleet, seed)
        if drawn:
            path.write_text(missions_text(APP, drawn), "utf-8")
            both = (files.load_missions, full_missions.load_missions)
            small, full = (plain(load(path, APP, fleet.airspace)) for load in both)
            assert small == full
