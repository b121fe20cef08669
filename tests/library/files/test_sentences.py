"""What is said of plan files with mistakes: all of them at once, each with its line and what would be right.

The files, and what must be said of each, are in `sentences/`.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.reading import parsed
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from tests.kit.sentences import check_sentences
from tests.library.files.an_app import APP
from tests.library.files.test_limits import extreme_app

SENTENCES = Path(__file__).parent / "sentences"
FENCED = Airspace(size=(20.0, 12.0), no_fly=(((8.0, 0.0), (9.0, 0.0), (9.0, 5.0), (8.0, 5.0)),))
BLOCKED = Airspace(
    size=(20.0, 12.0), no_fly=(((4.2, 2.2), (5.8, 2.2), (5.8, 3.8), (4.2, 3.8)),), ceiling=4.0
)
LIST = "nr,x,y\n1,2.5,3\n7,4,3.25\n"
OF_LIST = """
[[mission]]
name = "Bed {nr}"
each = "beds.csv"
[[mission.trip]]
action = "take_photo"
target = ["{x}", "{y}"]
"""


def of_missions(path: Path, text: str) -> object:
    """Read a missions file."""
    path.write_text(text, "utf-8")
    return load_missions(path, APP, FENCED)


def of_areas(path: Path, text: str) -> object:
    """Read a missions file with areas."""
    path.write_text(text, "utf-8")
    return load_missions(path, APP, BLOCKED)


def of_missions_of_lists(path: Path, text: str) -> object:
    """Read a missions file with a list beside it."""
    path.with_name("beds.csv").write_text(LIST, "utf-8")
    path.write_text(text, "utf-8")
    return load_missions(path, APP, Airspace())


def of_lists(path: Path, text: str) -> object:
    """Read a missions file beside a list."""
    path.with_name("beds.csv").write_text(text, "utf-8")
    path.write_text(OF_LIST, "utf-8")
    return load_missions(path, APP, Airspace())


def of_fleets(path: Path, text: str) -> object:
    """Read a fleet file."""
    path.write_text(text, "utf-8")
    return load_fleet(path, APP)


def of_missions_beyond(path: Path, text: str) -> object:
    """Read a missions file of an app that has all there is to ask for."""
    path.write_text(text, "utf-8")
    return load_missions(path, extreme_app(0), Airspace())


def of_fleets_beyond(path: Path, text: str) -> object:
    """Read a fleet file of that app."""
    path.write_text(text, "utf-8")
    return load_fleet(path, extreme_app(0))


def advice(path: Path, text: str) -> object:
    """Read a file that is not TOML; what is wrong there, other versions of Python word otherwise."""
    try:
        return parsed(str(path), text)
    except BadInput as error:
        raise BadInput(str(error).partition("`; ")[2]) from None


@pytest.mark.parametrize(
    ("name", "read"),
    [
        ("missions", of_missions),
        ("areas", of_areas),
        ("lists", of_lists),
        ("missions_of_lists", of_missions_of_lists),
        ("fleets", of_fleets),
        ("missions_beyond", of_missions_beyond),
        ("fleets_beyond", of_fleets_beyond),
        ("advice", advice),
    ],
)
def test_mistakes_are_told_with_their_lines(
    name: str, read: Callable[[Path, str], object], tmp_path: Path, update: bool
) -> None:
    """In the order of the file; of what is sound nothing is said."""

    def say(text: str) -> list[str]:
        try:
            read(tmp_path / "file.toml", text)
        except BadInput as error:
            return [line.removeprefix(f"{tmp_path}/") for line in str(error).split("\n")]
        return []

    check_sentences(SENTENCES / f"{name}.txt", say, update)
