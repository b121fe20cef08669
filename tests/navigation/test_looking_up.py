"""A fleet file is data: what it names is looked up, and not run to find out whether it is there."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pluto_fleet.drones import loading
from pluto_fleet.drones.loading import load_localization, load_navigation
from plutoc_runtime.domain.errors import BadInput
from tests.navigation import classes

RUN = "import pathlib; pathlib.Path({mark!r}).touch()\n"
GOOD = f"from {classes.__name__} import Good"


@pytest.fixture
def mark(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A file that modules of this folder write as they are run; they are found on Python's path."""
    folder = tmp_path / "installed"
    folder.mkdir()
    monkeypatch.syspath_prepend(folder)
    before = {*sys.modules}
    loading._loaded.cache_clear()
    yield tmp_path / "run"
    loading._loaded.cache_clear()
    for name in {*sys.modules} - before:
        if name.partition(".")[0] in ("theirs", "elsewhere"):
            del sys.modules[name]


def write(mark: Path, **modules: str) -> None:
    """Install modules that leave a mark when they are run; `a__b` is the module b of the package a."""
    for name, text in modules.items():
        path = mark.parent / "installed" / f"{name.replace('__', '/', 1)}.py"
        path.parent.mkdir(exist_ok=True)
        path.write_text(RUN.format(mark=str(mark)) + text)


@pytest.mark.parametrize(
    ("text", "named", "why"),
    [
        ("", "Drone", 'no class "Drone"'),
        ("class Drones: ...", "Drone", 'did you mean "Drones"?'),
        ("def Drone(setup): ...", "Drone", "is no class"),
        ("class Drone: ...", "Drone", "it has no method connect; it has no method preflight"),
        ("class Drone: ...", "Drone.Inner", 'no class "Inner"'),
        ("def make():\n    class Drone: ...", "Drone", 'no class "Drone"'),
        ("from os import path as Drone", "Drone", '"os" is a module of Python\'s own'),
        ("from elsewhere import Drone", "Drone", 'no class "Drone"'),
        ("from elsewhere import *", "Drone", 'no class "Drone"'),
        ("from gone import Drone", "Drone", 'needs "gone"'),
        ("from theirs import Drone", "Drone", 'no class "Drone"'),
        ("from ... import Drone", "Drone", 'no class "Drone"'),
        ("def __getattr__(name): return OTHERS[name]", "Drone", 'no class "Drone"'),
        ("1 +", "Drone", "cannot be imported: SyntaxError"),
    ],
)
@pytest.mark.parametrize("load", [load_navigation, load_localization])
def test_a_module_without_the_class_is_not_run(
    mark: Path, text: str, named: str, why: str, load: Callable[[str], object]
) -> None:
    """Without being imported: a fleet file from elsewhere may name anything."""
    write(mark, theirs=text, elsewhere="")
    why = why if load is load_navigation else why.replace("connect; it has no method preflight", "")
    with pytest.raises(BadInput) as refused:
        load(f"theirs:{named}")
    assert why in str(refused.value)
    assert not mark.exists()


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("antigravity:Drone", '"antigravity" is a module of Python\'s own'),
        ("idlelib.pyshell:PyShell", '"idlelib.pyshell" is a module of Python\'s own'),
        ("theirs.gone:Drone", 'there is no "theirs.gone"'),
        ("theirs.gone.far:Drone", 'there is no "theirs.gone"'),
        ("theirs.inner:Drone", 'no class "Drone"'),
        ("theirs.inner.far:Drone", 'there is no "theirs.inner.far"'),
    ],
)
def test_nor_is_what_a_module_stands_in(mark: Path, name: str, why: str) -> None:
    """The packages above it are run by an import, too."""
    write(mark, theirs____init__="", theirs__inner="")
    with pytest.raises(BadInput) as refused:
        load_navigation(name)
    assert why in str(refused.value)
    assert not mark.exists()
    assert "antigravity" not in sys.modules and "idlelib" not in sys.modules


@pytest.mark.parametrize(
    ("modules", "name"),
    [
        ({"theirs": GOOD}, "theirs:Good"),
        ({"theirs": f"{GOOD} as Drone"}, "theirs:Drone"),
        ({"theirs": f"{GOOD}\nclass Drone(Good): ..."}, "theirs:Drone"),
        ({"theirs": f"{GOOD}\nDrone = Good"}, "theirs:Drone"),
        ({"theirs": f"try:\n    {GOOD}\nexcept ImportError:\n    pass"}, "theirs:Good"),
        ({"theirs": f"{GOOD}\nclass Kit:\n    Drone = Good"}, "theirs:Kit.Drone"),
        ({"theirs": "from elsewhere import *", "elsewhere": GOOD}, "theirs:Good"),
        (
            {
                "theirs____init__": "from .inner import Drone",
                "theirs__inner": f"{GOOD} as Drone",
            },
            "theirs:Drone",
        ),
        (
            {"theirs____init__": "from . import inner", "theirs__inner": GOOD},
            "theirs:inner.Good",
        ),
        (
            {"theirs": f"{GOOD}\ndef __getattr__(name): return {{'Drone': Good}}[name]"},
            "theirs:Drone",
        ),
    ],
)
def test_a_class_is_found_however_its_module_comes_by_it(
    mark: Path, modules: dict[str, str], name: str
) -> None:
    """It is what the import gives, in the end."""
    write(mark, **modules)
    found = load_navigation(name)
    assert isinstance(found, type) and issubclass(found, classes.Good)
    assert mark.exists()
