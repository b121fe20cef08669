"""The reader in a package and the library's say the same of the same mistake, and that first.

The library says more: what would be right, and every other mistake, each with its line. In `sentences/` are files with
mistakes, each followed by what must be said of it: `->`, and nothing more for one that is accepted.
"""

from __future__ import annotations

import re
import tempfile
import tomllib
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.files import fleet as full_fleet
from pluto_fleet.files import missions as full_missions
from pluto_fleet.files.toml import toml_text
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.alone.files import LARGEST
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from tests.kit.sentences import entries
from tests.library.files.an_app import APP, OWN, PLAIN

if TYPE_CHECKING:
    from pluto_fleet.app import App

FENCED = Airspace(no_fly=(((4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)),))
PLACE = re.compile(
    r"""(?:(?:mission|drone) (?:"[^"]*"|\d+)(?:, trip (?:"[^"]*"|\d+))?(?:, (?:item|parameters))?"""
    r"|\[\[?[\w.]+\]?\]|map|fleet|motion|world(?:\.\w+)?)(?:: |, (?=\w+ is not a table))"
)
"""What the mistake is in: the small reader has no lines, and calls tables in its own way."""
FURTHER = re.compile(r"[;:] |, such as |, with two brackets|, in line ")
"""Where what would be right begins, or where the other one is."""

Load = Callable[[Path], object]


def first(load: Load, path: Path) -> str:
    """Return the first sentence about a file, without its place; nothing of one that is accepted."""
    try:
        load(path)
    except BadInput as error:
        said = re.sub(rf"^{re.escape(str(path))}(:\d+)?: ", "", str(error).split("\n")[0])
        place = PLACE.match(said)
        return FURTHER.split(said[place.end() :] if place else said)[0]
    return ""


def of_fleet(path: Path, app: App = APP) -> tuple[str, str]:
    """Return what both readers say of a fleet file."""
    return (
        first(lambda path: files.load_fleet(path, app), path),
        first(lambda path: full_fleet.load_fleet(path, app), path),
    )


def of_missions(path: Path, app: App = APP) -> tuple[str, str]:
    """Return what both readers say of a missions file."""
    return (
        first(lambda path: files.load_missions(path, app, FENCED), path),
        first(lambda path: full_missions.load_missions(path, app, FENCED), path),
    )


SENTENCES = Path(__file__).parent / "sentences"
M = '[[mission]]\nname = "north"\n'
TRIP = '[[mission.trip]]\naction = "measure"\ntarget = [2, 3]\n'
PICK = (
    '[[mission.trip]]\naction = "pick_item"\ntarget = [1, 2]\nitem = { name = "p", mass = 0.001 }\n'
)
MONSTERS = [
    (f"{M}x = {'[' * 5000}", "is nested too deep"),
    (f"{M}safe_time = {'9' * 5000}\n{TRIP}", "is not valid TOML"),
    (f"{M}safe_time = 0x{'f' * 5000}\n{TRIP}", "safe_time this number is too large"),
]
"""What is too long to be written down."""


def mistakes(name: str) -> list[tuple[str, str]]:
    """Return the files with mistakes of a list, and what must be said of each."""
    return [(text, said) for text, (said,) in entries(SENTENCES / f"{name}.txt")]


@pytest.mark.parametrize(("text", "said"), mistakes("fleets"))
def test_a_fleet_that_cannot_fly_is_refused_alike(tmp_path: Path, text: str, said: str) -> None:
    """Every key, and every kind of value."""
    path = tmp_path / "fleet.toml"
    path.write_text(text, "utf-8")
    assert of_fleet(path) == (said, said)


@pytest.mark.parametrize(
    ("app", "text", "said"),
    [
        *((APP, *one) for one in (*mistakes("missions"), *MONSTERS)),
        *((OWN, *one) for one in mistakes("own_fields")),
        (PLAIN, f'{M}evaluator = "x"\n{TRIP}', 'unknown key "evaluator"'),
        (PLAIN, f"{M}{TRIP}delay = 3", 'unknown key "delay"'),
    ],
)
def test_missions_that_cannot_be_flown_are_refused_alike(
    tmp_path: Path, app: App, text: str, said: str
) -> None:
    """The same for them, also for fields of the app's own and for an app without any."""
    path = tmp_path / "missions.toml"
    path.write_text(text, "utf-8")
    assert of_missions(path, app) == (said, said)


def test_the_place_is_told(tmp_path: Path) -> None:
    """By the small reader, too: the file, the table in it, and in TOML that is none the line."""
    path = tmp_path / "x.toml"
    for text, where in (
        (f"{M}{TRIP}{TRIP}delay = -1", ': mission "north", trip 2: delay -1 is less'),
        (f"[[mission]]\n{PICK.replace('0.001', '-1')}", ": mission 1, trip 1, item: mass -1 is"),
        ("a = 1\nb = 1 2\n", ":2: is not valid TOML: expected newline"),
    ):
        path.write_text(text)
        with pytest.raises(BadInput, match=re.escape(f"{path}{where}")):
            files.load_missions(path, APP, FENCED)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "there is no such file"),
        (b"a = 1\nb = '\xff\xfe'", "is not UTF-8 text"),
        (b"#" * LARGEST + b"#", "is larger than 1024 KiB"),
        (b"#" * LARGEST, "has no [[mission]]"),
        (b"\xef\xbb\xbf", "has no [[mission]]"),
        (b"a = '" + b"k." * 500 + b"'", 'unknown key "a"'),
    ],
)
def test_what_is_no_plan_file_is_refused_alike(
    tmp_path: Path, content: bytes | None, said: str
) -> None:
    """Missing, not UTF-8, too large; and what only looks so."""
    path = tmp_path / "missions.toml"
    if content is not None:
        path.write_bytes(content)
    assert of_missions(path) == (said, said)
    assert of_missions(tmp_path) == ("is a folder, not a file", "is a folder, not a file")
    assert of_fleet(Path("a\0b")) == ("is not a file name", "is not a file name")


def test_what_must_be_filled_in_is_told_with_what_to_write(tmp_path: Path) -> None:
    """By both, and by the library with the line of the table that lacks it."""
    path = tmp_path / "missions.toml"
    path.write_text(f"{M}{TRIP}", "utf-8")
    says = 'has no patient: write patient = "text"'
    with pytest.raises(BadInput) as small:
        files.load_missions(path, OWN, FENCED)
    assert str(small.value) == f'{path}: mission "north": {says}'
    with pytest.raises(BadInput) as full:
        full_missions.load_missions(path, OWN, FENCED)
    assert str(full.value).split("\n") == [
        f'{path}:1: mission "north": {says}',
        f'{path}:3: mission "north", trip 1: has no fragile: write fragile = true',
        f'{path}:3: mission "north", trip 1: has no warmth: write warmth = "1 K"',
    ]


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
def mistaken(draw: st.DrawFn, text: str) -> str:
    """Return a file with up to three changes: something less, something more, or something else."""
    data = tomllib.loads(text)
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


def without(name: str) -> str:
    """Return the file without a mistake."""
    return (SENTENCES / name).read_text("utf-8")


@settings(max_examples=50, deadline=None)
@given(*(mistaken(without(name)) for name in ("fleet.toml", "missions.toml", "own_missions.toml")))
def test_files_with_mistakes_at_random_are_read_alike(fleet: str, missions: str, own: str) -> None:
    """Both accept them, or both refuse them with the same first sentence."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "x.toml")
        for text, read in (
            (fleet, of_fleet),
            (missions, of_missions),
            (own, lambda path: of_missions(path, OWN)),
        ):
            path.write_text(text, "utf-8")
            small, full = read(path)
            assert small == full


def test_the_files_without_mistakes_are_accepted() -> None:
    """So that each change is one."""
    assert of_fleet(SENTENCES / "fleet.toml") == ("", "")
    assert of_missions(SENTENCES / "missions.toml") == ("", "")
    assert of_missions(SENTENCES / "own_missions.toml", OWN) == ("", "")
