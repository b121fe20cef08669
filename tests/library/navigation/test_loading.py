"""A navigation is found by its name, and looked at before anything flies."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path

import pytest

from pluto_fleet.drones import inspection
from pluto_fleet.drones.loading import (
    load_localization,
    load_navigation,
    make_localization,
    make_navigation,
)
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.navigation import classes
from tests.library.navigation.simulated import setup

HERE = classes.__name__
CLASSES = """
class Drone:
    async def connect(self): ...
class Eyes:
    async def positions(self): ...
"""


def refused(name: str) -> str:
    """Return why a name is no navigation."""
    with pytest.raises(BadInput) as error:
        load_navigation(name)
    return str(error.value)


def offered(folder: Path, package: str, group: str, lines: str) -> None:
    """Install a package that offers something."""
    info = folder / f"{package.replace('-', '_')}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[{group}]\n{lines}\n")


@pytest.mark.parametrize("name", ["Good", "Late", "Holder.Inner"])
def test_a_class_is_named_by_its_module(name: str) -> None:
    found = load_navigation(f"{HERE}:{name}")
    assert getattr(found, "__qualname__", None) == name


def test_a_package_offers_a_class_by_an_entry_point(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    offered(tmp_path, "pluto-wren", "plutoc.navigations", f"wren = {HERE}:Good")
    offered(tmp_path, "pluto-eyes", "plutoc.localizations", f"eyes = {HERE}:Cameras")
    monkeypatch.syspath_prepend(tmp_path)
    assert load_navigation("wren") == classes.Good
    assert load_localization("eyes") == classes.Cameras


def test_of_two_packages_that_offer_one_name_neither_is_chosen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    offered(tmp_path, "pluto-one", "plutoc.navigations", f"twin = {HERE}:Good")
    offered(tmp_path, "pluto-two", "plutoc.navigations", f"twin = {HERE}:Late")
    monkeypatch.syspath_prepend(tmp_path)
    assert refused("twin") == (
        'several installed packages offer a navigation "twin": name the class itself, one of '
        f'"{HERE}:Good", "{HERE}:Late"'
    )


def test_a_name_that_no_package_offers_is_told_with_those_that_are(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    offered(tmp_path, "pluto-wren", "plutoc.navigations", f"parakeet = {HERE}:Good")
    monkeypatch.syspath_prepend(tmp_path)
    assert refused("parakete").startswith(
        'no navigation "parakete" is installed; did you mean "parakeet"? there is: '
    )
    with pytest.raises(BadInput, match="no localization"):
        load_localization("lighthouse")


def test_a_module_must_be_installed() -> None:
    assert "PYTHONPATH" in refused("no_such_module_here:Drone")
    assert '"tests.library.navigation.nowhere"' in refused("tests.library.navigation.nowhere:Drone")


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
        ("import sys; sys.exit(3)", "cannot be imported: SystemExit: 3"),
        ("raise BaseException('no')", "cannot be imported: BaseException: no"),
        ("import asyncio; raise asyncio.CancelledError", "cannot be imported: CancelledError"),
    ],
)
def test_what_a_module_raises_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, why: str
) -> None:
    (tmp_path / "broken_drones.py").write_text(f"{text}\n{CLASSES}")
    monkeypatch.syspath_prepend(tmp_path)
    assert why in refused("broken_drones:Drone")


@pytest.mark.parametrize(
    ("text", "how"),
    [
        ("import os; os._exit(0)", "exit code 0"),
        ("import os; os.write(2, b'no\\nlicence\\x1b\\n'); os._exit(7)", "exit code 7"),
        ("import os; os.kill(os.getpid(), 9)", "killed by SIGKILL"),
    ],
)
def test_a_module_that_ends_the_process_ends_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, how: str
) -> None:
    (tmp_path / "quitting_drones.py").write_text(f"{text}\n{CLASSES}")
    monkeypatch.syspath_prepend(tmp_path)
    said = "; the last it said: licence" if "licence" in text else ""
    assert refused("quitting_drones:Drone").startswith(
        'the navigation "quitting_drones:Drone" cannot be imported: "quitting_drones" ends the'
        f" process that imports it ({how}){said}"
    )


def test_a_module_that_hangs_is_not_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is named, and there is a limit."""
    monkeypatch.setattr(inspection, "IMPORT_LIMIT", 0.5)
    (tmp_path / "hanging_drones.py").write_text(f"while True: pass\n{CLASSES}")
    monkeypatch.syspath_prepend(tmp_path)
    assert refused("hanging_drones:Drone") == (
        'the navigation "hanging_drones:Drone" cannot be imported: "hanging_drones" was not done'
        " with that in 0.5 s"
    )
    with pytest.raises(BadInput, match="was not done with that"):
        load_localization("hanging_drones:Eyes")


@pytest.mark.parametrize("error", [SystemExit(3), BaseException("no")])
def test_a_class_whose_making_ends_all_ends_nothing(error: BaseException) -> None:
    def end(_: object) -> None:
        raise error

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(classes.Good, "__init__", lambda self, setup: end(setup))
        with pytest.raises(BadInput, match="could not be made for cf1"):
            make_navigation(f"{HERE}:Good", setup())


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


def test_half_of_what_belongs_together_is_not_enough() -> None:
    assert "it has act but no why_not: both belong together" in refused(f"{HERE}:Half")


def test_who_is_there_is_asked_of_the_class() -> None:
    assert load_navigation(f"{HERE}:Looking") == classes.Looking
    assert "its scan must be a staticmethod" in refused(f"{HERE}:Shy")


def test_a_localization_is_looked_at_too() -> None:
    with pytest.raises(BadInput, match=r"__init__ must take .options.; its positions must be"):
        load_localization(f"{HERE}:Blind")
    made = make_localization(f"{HERE}:Cameras", {"port": 5000})
    assert isinstance(made, classes.Cameras) and made.options == {"port": 5000}


def test_what_cannot_be_made_says_whose_it_is() -> None:
    with pytest.raises(BadInput, match="could not be made for cf1: ValueError: radio = 3"):
        make_navigation(f"{HERE}:Choosy", setup())


def test_nothing_is_called_of_what_is_only_looked_at() -> None:
    """A class that cannot be made can still be looked at."""
    assert load_navigation(f"{HERE}:Choosy") == classes.Choosy


def test_what_is_made_is_made_of_the_setup() -> None:
    async def made() -> object:
        return make_navigation(f"{HERE}:Good", setup())

    assert isinstance(asyncio.run(made()), classes.Good)


def test_what_a_module_raises_commands_no_terminal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nor does it fill one: another author wrote it."""
    (tmp_path / "loud_drones.py").write_text(
        f"raise RuntimeError('\\x1b[31mred\\n' + 9999 * 'very ')\n{CLASSES}"
    )
    monkeypatch.syspath_prepend(tmp_path)
    said = refused("loud_drones:Drone")
    assert said.isprintable()
    assert len(said) < 500
