"""The two files of a plan, as a package alone reads them, and the library by the same functions.

In `sentences/` are files with mistakes, each followed by all that must be said of it: `->`, and nothing more for
one that is accepted.
"""

from __future__ import annotations

import tempfile
import tomllib
from collections.abc import Callable
from copy import deepcopy
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.files import fleet as full_fleet
from pluto_fleet.files import missions as full_missions
from pluto_fleet.files.toml import toml_text
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.alone import simulate as alone
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.fleet_data import DroneData, FleetData
from tests.kit.apps import EXAMPLES
from tests.kit.sentences import check_sentences
from tests.library.files.an_app import APP, OWN, PLAIN
from tests.library.files.test_fleet import FULL

if TYPE_CHECKING:
    from pluto_fleet.app import App
    from tests.kit.apps import Example

SENTENCES = Path(__file__).parent / "sentences"
OF_THE_LIBRARY = {"night_round"}
"""The examples with promises, areas or lists, of which a package alone says what to install."""
FENCED = Airspace(no_fly=(((4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)),))
M = '[[mission]]\nname = "north"\n'
TRIP = '[[mission.trip]]\naction = "measure"\ntarget = [2, 3]\n'


def told(fleet: FleetData) -> object:
    """Return what the brain knows of a fleet."""
    drones = [
        tuple(getattr(drone, one.name) for one in fields(DroneData)) for drone in fleet.drones
    ]
    behaviour = fleet.after_trip, fleet.max_airborne, fleet.motion
    return fleet.airspace, drones, behaviour, fleet.world


def said(load: Callable[[Path], object], path: Path) -> list[str]:
    """Return all that is said of a file, without its place; nothing of one that is accepted."""
    try:
        load(path)
    except BadInput as error:
        return [line.partition(": ")[2] for line in f"{error}".split("\n")]
    return []


def load_fleet(path: Path) -> object:
    return files.load_fleet(path, APP)


def load_missions(path: Path) -> object:
    return files.load_missions(path, APP, FENCED)


def load_own(path: Path) -> object:
    return files.load_missions(path, OWN, FENCED)


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
    assert repr(missions) == repr([*example.missions])


def test_what_only_real_flights_need_is_passed_over(tmp_path: Path) -> None:
    """Of any type."""
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


@pytest.mark.parametrize(
    ("name", "load"),
    [("fleets", load_fleet), ("missions", load_missions), ("own_fields", load_own)],
)
def test_all_mistakes_are_told_at_once(
    name: str, load: Callable[[Path], object], tmp_path: Path, update: bool
) -> None:
    """By a package alone, too: each with the table that it is in."""
    path = tmp_path / "file.toml"

    def say(text: str) -> list[str]:
        path.write_text(text, "utf-8")
        return said(load, path)

    check_sentences(SENTENCES / f"{name}.txt", say, update)


def test_what_is_no_plan_file_is_refused(tmp_path: Path) -> None:
    """Missing, a folder, not UTF-8, not TOML."""
    path = tmp_path / "missions.toml"
    for content, why in (
        (None, "No such file or directory"),
        (b"a = 1\nb = '\xff\xfe'", "codec can't decode"),
        (b"a = [", "at end of document"),
        (b"x = " + b"[" * 5000, "cannot be read"),
        (b"x = " + b"9" * 5000, "cannot be read"),
    ):
        if content is not None:
            path.write_bytes(content)
        with pytest.raises(BadInput, match=why):
            load_missions(path)
    with pytest.raises(BadInput, match="Is a directory"):
        load_fleet(tmp_path)


KEYS = """
patient margin fragile layers warmth id name category home kind at radius quantity peak mass item parameters dose trip
mission drone map world source feature target action delay priority repeat safe_time evaluator motion legs limit
settles pace taper size gap x
"""
VALUES = (
    st.sampled_from(
        ("", " a", "a\n", "cf1", "north", "p", "scout", "measure", "pick_item", "release_item",
         "3 m", "3 s", "3 g", "3", "1e3 m", "20 %", "08:00", "stay", "smooth", "1 m/s", "find_blooms", "x" * 300, "1")
    )
    | st.sampled_from((0, 1, -1, 3, 1e3, 1e12, -1e12, 10**20, 0.05, float("nan"), float("inf")))
    | st.booleans()
    | st.sampled_from(
        ([], {}, [1], [1, 1], [0.5, 0.5], [1, 1, 1], [4.5, 4.5], [1, "2 m"], [1, "2 s"], [99, 1],
         [[[0, 0], [1, 0], [0, 1]]], [[[0, 0], [1, 0], [2, 0]]], [{}], [{}, 3], {"x": 1})
    )
)  # fmt: skip


def places(data: object, place: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Return the paths to everything in a file."""
    inner: list[tuple[Any, Any]] = []
    if isinstance(data, dict | list):
        inner = [*(data.items() if isinstance(data, dict) else enumerate(data))]
    return [place, *(path for key, one in inner for path in places(one, (*place, key)))]


@st.composite
def mistaken(draw: st.DrawFn, name: str) -> str:
    """Return a file with up to three changes: something less, something more, or something else."""
    data = tomllib.loads((SENTENCES / name).read_text("utf-8"))
    for _ in range(draw(st.integers(1, 3))):
        *way, last = draw(st.sampled_from(places(data)[1:]))
        around: Any = data
        for step in way:
            around = around[step]
        match draw(st.sampled_from(("less", "more", "else", "again"))):
            case "less":
                del around[last]
            case "more" if isinstance(around, dict):
                around[draw(st.sampled_from(KEYS.split()))] = deepcopy(draw(VALUES))
            case "again" if isinstance(around, list):
                around.append(deepcopy(around[last]))
            case _:
                around[last] = deepcopy(draw(VALUES))
        if not data:
            break
    return toml_text(data)


@settings(max_examples=50, deadline=None)
@given(*(mistaken(name) for name in ("fleet.toml", "missions.toml", "own_missions.toml")))
def test_mistakes_at_random_are_refused_with_and_without_the_library(
    fleet: str, missions: str, own: str
) -> None:
    """Nothing else than `BadInput` is ever raised, and both refuse the same."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "x.toml")
        for text, small, full in (
            (fleet, load_fleet, lambda path: full_fleet.load_fleet(path, APP)),
            (missions, load_missions, lambda path: full_missions.load_missions(path, APP, FENCED)),
            (own, load_own, lambda path: full_missions.load_missions(path, OWN, FENCED)),
        ):
            path.write_text(text, "utf-8")
            assert bool(said(small, path)) == bool(said(full, path))


def test_the_files_without_mistakes_are_accepted() -> None:
    """So that each change is one."""
    assert said(load_fleet, SENTENCES / "fleet.toml") == []
    assert said(load_missions, SENTENCES / "missions.toml") == []
    assert said(load_own, SENTENCES / "own_missions.toml") == []
