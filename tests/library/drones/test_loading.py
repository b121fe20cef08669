"""A navigation is found by its name, and looked at before anything flies or is run."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path

import pytest

from pluto_fleet.drones.loading import (
    load_localization,
    load_navigation,
    make_localization,
    make_navigation,
)
from pluto_fleet.drones.protocol import DroneSetup
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.drones import classes

HERE = classes.__name__
CLASSES = """
class Drone:
    async def connect(self): ...
class Eyes:
    async def positions(self): ...
"""
SETUP = DroneSetup(id="cf1", uri=None, home=(1.0, 2.0, 0.0), speed=0.5, options={}, folder=Path())
_numbers = count()


class Installed:
    """A folder of modules that are found on Python's path."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.mark = folder / "run"
        """What modules that are written with `marked` write when they are run."""
        self.author = f"author{next(_numbers)}"
        """The name of the module `author` in this test: no two tests share one."""

    def named(self, text: str) -> str:
        """Return a text in which the module `author` has its name."""
        return text.replace("author", self.author)

    def write(self, *, marked: bool = False, **modules: str) -> None:
        """Install modules; `a__b` is the module b of the package a."""
        mark = f"import pathlib; pathlib.Path({str(self.mark)!r}).touch()\n" if marked else ""
        for name, text in modules.items():
            path = self.folder / f"{self.named(name).replace('__', '/', 1)}.py"
            path.parent.mkdir(exist_ok=True)
            path.write_text(mark + self.named(text))

    def offers(self, package: str, group: str, lines: str) -> None:
        info = self.folder / f"{package.replace('-', '_')}-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text(f"[{group}]\n{lines}\n")


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Installed]:
    """What is installed beside what the tests need."""
    monkeypatch.syspath_prepend(tmp_path)
    before = {*sys.modules}
    yield Installed(tmp_path)
    for name in {*sys.modules} - before:
        if name.partition(".")[0].startswith(("author", "elsewhere")):
            del sys.modules[name]


def refused(name: str, load: Callable[[str], object] = load_navigation) -> str:
    with pytest.raises(BadInput) as error:
        load(name)
    return str(error.value)


@pytest.mark.parametrize("name", ["Good", "Late", "Holder.Inner"])
def test_a_class_is_named_by_its_module(name: str) -> None:
    found = load_navigation(f"{HERE}:{name}")
    assert getattr(found, "__qualname__", None) == name


def test_a_package_offers_a_class_by_an_entry_point(installed: Installed) -> None:
    installed.offers("pluto-wren", "plutoc.navigations", f"wren = {HERE}:Good")
    installed.offers("pluto-eyes", "plutoc.localizations", f"eyes = {HERE}:Cameras")
    assert load_navigation("wren") == classes.Good
    assert load_localization("eyes") == classes.Cameras


def test_of_two_packages_that_offer_one_name_neither_is_chosen(installed: Installed) -> None:
    installed.offers("pluto-one", "plutoc.navigations", f"twin = {HERE}:Good")
    installed.offers("pluto-two", "plutoc.navigations", f"twin = {HERE}:Late")
    assert refused("twin") == (
        'several installed packages offer a navigation "twin": name the class itself, one of '
        f'"{HERE}:Good", "{HERE}:Late"'
    )


def test_a_name_that_no_package_offers_is_told_with_those_that_are(installed: Installed) -> None:
    installed.offers("pluto-wren", "plutoc.navigations", f"parakeet = {HERE}:Good")
    assert refused("parakete").startswith(
        'no navigation "parakete" is installed; did you mean "parakeet"? there is: '
    )
    with pytest.raises(BadInput, match="no localization"):
        load_localization("lighthouse")


def test_the_folder_where_one_happens_to_be_is_no_place_for_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not even for `python -m`, which looks there first; unless it is named on purpose."""
    (tmp_path / "found_beside_a_fleet_file.py").write_text("class Drone: pass")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    assert "in no module that is installed" in refused("found_beside_a_fleet_file:Drone")
    monkeypatch.setattr(sys, "path", [str(tmp_path), str(tmp_path), *sys.path[1:]])
    assert "it has no method connect" in refused("found_beside_a_fleet_file:Drone")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("import no_such_library", 'needs "no_such_library": install it with pip'),
        ("1 / 0", "cannot be imported: ZeroDivisionError"),
        ("import asyncio; raise asyncio.CancelledError", "cannot be imported: CancelledError"),
    ],
)
def test_what_a_module_raises_is_told(installed: Installed, text: str, why: str) -> None:
    installed.write(author=f"{text}\n{CLASSES}")
    assert why in refused(f"{installed.author}:Drone")


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("Goot", 'its module has no class "Goot"; did you mean "Good"?'),
        ("Holder.Outer", 'has no class "Outer"'),
        ("NUMBER", "is no class"),
        ("setup()", "write module:Class"),
        ("", "write module:Class"),
    ],
)
def test_what_is_named_must_be_a_class(name: str, why: str) -> None:
    assert why in refused(f"{HERE}:{name}")


def test_everything_that_a_class_lacks_is_told_at_once() -> None:
    assert refused(f"{HERE}:Lazy").partition(" cannot be used: ")[2].split("; ") == [
        "it cannot be made: its __init__ must take (setup)",
        "its connect must be `async def`",
        "its takeoff cannot be called so: it takes (height, speed)",
        "it has no method go_to",
        "its land is no method",
        "its telemetry must be a property: put @property above it",
        "its events must be an async generator, or `def` and return an async iterator",
    ]


def test_who_is_there_is_asked_of_the_class() -> None:
    assert load_navigation(f"{HERE}:Looking") == classes.Looking
    assert "its scan must be a staticmethod" in refused(f"{HERE}:Shy")


def test_a_localization_is_looked_at_too() -> None:
    with pytest.raises(BadInput, match=r"__init__ must take .options.; its positions must be"):
        load_localization(f"{HERE}:Blind")
    made = make_localization(f"{HERE}:Cameras", {"port": 5000})
    assert isinstance(made, classes.Cameras) and made.options == {"port": 5000}


@pytest.mark.parametrize("error", [ValueError("radio = 3"), SystemExit(3), BaseException("no")])
def test_what_cannot_be_made_says_whose_it_is_and_ends_nothing(
    error: BaseException, monkeypatch: pytest.MonkeyPatch
) -> None:
    def end(*_: object) -> None:
        raise error

    monkeypatch.setattr(classes.Good, "__init__", end)
    with pytest.raises(BadInput, match=f"not be made for cf1: {type(error).__name__}: {error}"):
        make_navigation(f"{HERE}:Good", SETUP)


# A fleet file is data: what it names is looked up, and not run to find out whether it is there

GOOD = f"from {HERE} import Good"


@pytest.mark.parametrize(
    ("text", "named", "why"),
    [
        ("class Drones: ...", "Drone", 'did you mean "Drones"?'),
        ("from elsewhere import Other", "Drone.Inner", 'no class "Drone"'),
    ],
)
@pytest.mark.parametrize("load", [load_navigation, load_localization])
def test_a_module_without_the_class_is_not_run(
    installed: Installed, text: str, named: str, why: str, load: Callable[[str], object]
) -> None:
    """For all else that it does as it is imported: a fleet file from elsewhere may name anything."""
    installed.write(marked=True, author=text, elsewhere="")
    assert installed.named(why) in refused(f"{installed.author}:{named}", load)
    assert not installed.mark.exists()


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("antigravity:Drone", '"antigravity" is a module of Python\'s own'),
        ("idlelib.pyshell:PyShell", '"idlelib.pyshell" is a module of Python\'s own'),
        ("author.gone:Drone", 'there is no "author.gone"'),
        ("author.inner:Drone", 'no class "Drone"'),
        ("author.inner.far:Drone", 'there is no "author.inner.far"'),
    ],
)
def test_nor_is_what_a_module_stands_in(installed: Installed, name: str, why: str) -> None:
    """The packages above it are run by an import, too."""
    installed.write(marked=True, author____init__="", author__inner="")
    assert installed.named(why) in refused(installed.named(name))
    assert not installed.mark.exists()
    assert "antigravity" not in sys.modules and "idlelib" not in sys.modules


@pytest.mark.parametrize(
    ("modules", "name"),
    [
        ({"author": f"{GOOD}\nclass Drone(Good): ..."}, "author:Drone"),
        ({"author": f"{GOOD}\nDrone = Good"}, "author:Drone"),
        ({"author": f"try:\n    {GOOD}\nexcept ImportError:\n    pass"}, "author:Good"),
        ({"author": f"{GOOD}\nclass Kit:\n    Drone = Good"}, "author:Kit.Drone"),
        ({"author": "from elsewhere import *", "elsewhere": GOOD}, "author:Good"),
        (
            {"author____init__": "from .inner import Drone", "author__inner": f"{GOOD} as Drone"},
            "author:Drone",
        ),
        ({"author____init__": "from . import inner", "author__inner": GOOD}, "author:inner.Good"),
        (
            {"author": f"{GOOD}\ndef __getattr__(name): return {{'Drone': Good}}[name]"},
            "author:Drone",
        ),
    ],
)
def test_a_class_is_found_however_its_module_comes_by_it(
    installed: Installed, modules: dict[str, str], name: str
) -> None:
    """It is what the import gives, in the end."""
    installed.write(marked=True, **modules)
    found = load_navigation(installed.named(name))
    assert isinstance(found, type) and issubclass(found, classes.Good)
    assert installed.mark.exists()
