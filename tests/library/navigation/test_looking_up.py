"""A fleet file is data: what it names is looked up, and not run to find out whether it is there."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pluto_fleet.drones import loading
from pluto_fleet.drones.loading import load_localization, load_navigation
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.navigation import classes

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
        if name.partition(".")[0] in ("author", "elsewhere"):
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
        ("from author import Drone", "Drone", 'no class "Drone"'),
        ("from ... import Drone", "Drone", 'no class "Drone"'),
        ("def __getattr__(name): return OTHERS[name]", "Drone", 'no class "Drone"'),
        ("1 +", "Drone", "cannot be imported: SyntaxError"),
    ],
)
@pytest.mark.parametrize("load", [load_navigation, load_localization])
def test_a_module_without_the_class_is_not_run(
    mark: Path, text: str, named: str, why: str, load: Callable[[str], object]
) -> None:
    """For all else that it does as it is imported: a fleet file from elsewhere may name anything."""
    write(mark, author=text, elsewhere="")
    why = why if load is load_navigation else why.replace("connect; it has no method preflight", "")
    with pytest.raises(BadInput) as refused:
        load(f"author:{named}")
    assert why in str(refused.value)
    assert not mark.exists()


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("antigravity:Drone", '"antigravity" is a module of Python\'s own'),
        ("idlelib.pyshell:PyShell", '"idlelib.pyshell" is a module of Python\'s own'),
        ("author.gone:Drone", 'there is no "author.gone"'),
        ("author.gone.far:Drone", 'there is no "author.gone"'),
        ("author.inner:Drone", 'no class "Drone"'),
        ("author.inner.far:Drone", 'there is no "author.inner.far"'),
    ],
)
def test_nor_is_what_a_module_stands_in(mark: Path, name: str, why: str) -> None:
    """The packages above it are run by an import, too."""
    write(mark, author____init__="", author__inner="")
    with pytest.raises(BadInput) as refused:
        load_navigation(name)
    assert why in str(refused.value)
    assert not mark.exists()
    assert "antigravity" not in sys.modules and "idlelib" not in sys.modules


@pytest.mark.parametrize(
    ("modules", "name"),
    [
        ({"author": GOOD}, "author:Good"),
        ({"author": f"{GOOD} as Drone"}, "author:Drone"),
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
    mark: Path, modules: dict[str, str], name: str
) -> None:
    """It is what the import gives, in the end."""
    write(mark, **modules)
    found = load_navigation(name)
    assert isinstance(found, type) and issubclass(found, classes.Good)
    assert mark.exists()
