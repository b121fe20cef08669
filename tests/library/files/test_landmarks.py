"""Named places, zones, north and the floor plan of a fleet file, and missions that name them."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.files.fleet import FleetFile, fleet_of, load_fleet
from pluto_fleet.files.landmarks import Landmarks, NamedPlace, Picture, Zone, crossing
from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.reading import parsed
from pluto_fleet.files.writing import fleet_text, with_landmarks
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.files.an_app import APP

DRONE = '[[drone]]\nid = "a"\nhome = [1, 1]\ncategory = "scout"\n'
WARD = f"""
[map]
size = [20.0, 12.0]
north = 30
image = {{ file = "ward.svg", at = [1, "50 cm"], size = [18, 10], turn = -90 }}
no_fly = [[[8, 0], [9, 0], [9, 5], [8, 5]]]

[[map.places]]
name = "Bed 3"
at = [2.5, 8]

[[map.places]]
name = "Shelf"
at = [4, 8, "80 cm"]

[[map.zones]]
name = "Field"
corners = [[1, 1], [5, 1], [5, 3], [1, 3], [1, 1]]
{DRONE}"""
TRIP = '[[mission]]\n[[mission.trip]]\naction = "measure"\ntarget = '


def fleet(folder: Path, text: str) -> FleetFile:
    """Load a fleet file."""
    (folder / "fleet.toml").write_text(text, "utf-8")
    return load_fleet(folder / "fleet.toml", APP)


def missions(folder: Path, text: str, of: str = WARD) -> list[Any]:
    """Load a missions file over a map."""
    (folder / "m.toml").write_text(text, "utf-8")
    team = fleet(folder, of)
    return load_missions(folder / "m.toml", APP, team.airspace, team.landmarks)


def test_a_map_has_named_places_zones_north_and_a_picture(tmp_path: Path) -> None:
    """In metres and degrees; a corner that closes an area is not there twice."""
    landmarks = fleet(tmp_path, WARD).landmarks
    assert landmarks == Landmarks(
        places=(
            NamedPlace(name="Bed 3", at=(2.5, 8.0)),
            NamedPlace(name="Shelf", at=(4.0, 8.0, 0.8)),
        ),
        zones=(Zone(name="Field", corners=((1.0, 1.0), (5.0, 1.0), (5.0, 3.0), (1.0, 3.0))),),
        north=30.0,
        picture=Picture(file="ward.svg", at=(1.0, 0.5), size=(18.0, 10.0), turn=-90.0),
    )
    written = fleet(tmp_path, fleet_text(fleet(tmp_path, WARD))).landmarks
    assert written == replace(landmarks, picture=None)


def test_a_target_may_be_a_named_place(tmp_path: Path) -> None:
    """At the cruise height unless the place has one; in a row of a list, too."""
    (tmp_path / "l.csv").write_text("where\nBed 3\nShelf\n", "utf-8")
    each = TRIP.replace("[[mission]]\n", '[[mission]]\neach = "l.csv"\n')
    found = missions(tmp_path, f'{each}"{{where}}"\nsource = "Shelf"')
    assert [one.trips[0].target for one in found] == [(2.5, 8.0, 1.2), (4.0, 8.0, 0.8)]
    assert found[0].trips[0].source == (4.0, 8.0, 0.8)
    with pytest.raises(BadInput, match='target "Bed 4" is no place of the map; did you mean "Bed'):
        missions(tmp_path, f'{TRIP}"Bed 4"')
    with pytest.raises(BadInput, match='target "Bed 3" is not a list of 2 or 3 numbers'):
        missions(tmp_path, f'{TRIP}"Bed 3"', DRONE)


def test_an_area_may_be_a_named_zone(tmp_path: Path) -> None:
    """Its trips are those of its corners."""
    area = '[[mission]]\n[[mission.area]]\naction = "measure"\nspacing = 2\npolygon = '
    by_name = missions(tmp_path, f'{area}"Field"')[0].trips
    by_hand = missions(tmp_path, f"{area}[[1, 1], [5, 1], [5, 3], [1, 3]]")[0].trips
    assert [one.target for one in by_name] == [one.target for one in by_hand]
    with pytest.raises(BadInput, match='polygon "Meadow" is no zone of the map; there are: Field'):
        missions(tmp_path, f'{area}"Meadow"')


CORNERS = st.lists(
    st.tuples(st.integers(0, 6).map(float), st.integers(0, 6).map(float)),
    min_size=3,
    max_size=7,
    unique=True,
)


@settings(max_examples=150, derandomize=True, deadline=None)
@given(CORNERS)
def test_what_crosses_itself_is_what_another_program_says_does(
    corners: list[tuple[float, float]],
) -> None:
    """On a coarse grid, where corners often lie on edges."""
    shape = shapely.Polygon(corners)
    assert (crossing(corners) is None) == (shape.is_valid and not math.isclose(shape.area, 0.0))


# Writing them

COMMENTED = """\
# Our ward.
[map]   # of the second floor
size = [20.0, 12.0]  # measured
image = "ward.svg"  # by the architect
no_fly = [
  [[8, 0], [9, 0], [9, 5], [8, 5]],  # the lift
]

# Beds.
[[map.places]]
name = "A"  # by the window
at = [1, 1]

# by the door
[[map.places]]
at = [2, 1]
name = "B"

# What is more
[[map.zones]]
name = "Z"
corners = [[1, 1], [2, 1], [2, 2]]

# Our drones.
[[drone]]
id = "a"   # the old one
home = [1, 1]
category = "scout"
"""
LISTED = f"""\
[map]
places = [{{ name = "A", at = [1, 1] }}]  # all
[map.image]
file = "ward.svg"  # by the architect
{DRONE}"""
TEXTS = [COMMENTED, LISTED, DRONE, "# ours\n" + DRONE.rstrip(), COMMENTED.replace("\n", "\r\n")]
SPOTS = st.lists(st.floats(0, 10).map(lambda x: round(x, 3)), min_size=2, max_size=3).map(tuple)
NAMES = st.sampled_from(["A", "B", "Z", "Bed 3", 'é "\\ # x', "[map]"])
ZONES = st.builds(
    lambda name, x: Zone(name=f"{name}!", corners=((x, 0.0), (x + 1.0, 0.0), (x, 1.0))),
    NAMES,
    st.integers(0, 9).map(float),
)
LANDMARKS = st.builds(
    Landmarks,
    places=st.lists(
        st.builds(NamedPlace, name=NAMES, at=SPOTS), max_size=4, unique_by=lambda one: one.name
    ).map(tuple),
    zones=st.lists(ZONES, max_size=3, unique_by=lambda one: one.name).map(tuple),
    north=st.integers(-360, 360).map(float),
    picture=st.none()
    | st.builds(
        Picture,
        file=st.sampled_from(["ward.svg", "new.png"]),
        at=st.just((1.0, 2.0)),
        size=st.sampled_from([(20.0, 12.0), (20.0, 20.0), (3.0, 4.0)]),
        turn=st.sampled_from([0.0, 90.0]),
    ),
)


def of_text(text: str) -> FleetFile:
    return fleet_of(parsed("fleet.toml", text), APP)


@settings(max_examples=30, derandomize=True, deadline=None)
@given(text=st.sampled_from(TEXTS), drawn=st.lists(LANDMARKS, min_size=1, max_size=3))
def test_what_is_written_is_read_and_all_else_stays(text: str, drawn: list[Landmarks]) -> None:
    """Whatever is drawn, once or several times: its comments, its order, and its line ends."""
    for landmarks in drawn:
        before = of_text(text)
        written = with_landmarks(text, before.landmarks, landmarks, before.airspace.size)
        after = of_text(written)
        for key in ("north", "picture"):
            assert getattr(after.landmarks, key) == getattr(landmarks, key)
        for key in ("places", "zones"):  # known ones keep their order, new ones follow
            assert set(getattr(after.landmarks, key)) == set(getattr(landmarks, key))
        assert shown_alike(before) == shown_alike(after)
        assert outside(written) == outside(text)
        assert with_landmarks(written, after.landmarks, after.landmarks, (20, 12)) == written
        text = written


def shown_alike(team: FleetFile) -> object:
    return replace(
        team, landmarks=Landmarks(), drones=tuple(replace(one, line=0) for one in team.drones)
    )


def outside(text: str) -> list[str]:
    """Return the lines with a comment of their own, and those of drones."""
    lines = text.split("\n")
    of_drones = lines.index("[[drone]]" + "\r" * text.count("\r\n", 0, 20))
    return [
        line
        for n, line in enumerate(lines)
        if line.startswith("#") or of_drones <= n < of_drones + 4
    ]


def test_a_map_without_a_header_of_its_own_is_not_touched() -> None:
    """It is said what to write."""
    text = f"map.size = [20, 20]\n{DRONE}"
    with pytest.raises(BadInput, match=r"write the line \[map\] above its keys"):
        with_landmarks(text, Landmarks(), Landmarks(north=3.0), (20.0, 20.0))
