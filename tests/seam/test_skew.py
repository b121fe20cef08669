"""Apps and libraries of unlike versions: they fly, or one sentence says what to install."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import pluto_fleet
from pluto_fleet.seam import NEWEST, OLDEST, problem, written
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.app import SEAM, moving
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.motion import CRAZYFLIE, PEAK, STRAIGHT, Motion
from tests.kit.apps import EXAMPLES, compiled
from tests.library.files.an_app import APP

NAME = "drugs_distribution"
LIBRARY = Path(pluto_fleet.__path__[0]).parent
EXAMPLE = EXAMPLES / NAME
SIMULATE = ("simulate", str(EXAMPLE / "missions.toml"))
FIRST = SEAM[0]


def said(package: Path, library: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run a command of a package beside a library."""
    paths = os.pathsep.join([str(package / "src"), str(library)])
    return subprocess.run(
        [sys.executable, "-m", NAME, *words],
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True,
        text=True,
        check=False,
    )


def library_that_speaks(folder: Path, oldest: str, newest: str, version: str) -> Path:
    """Return today's library, made to say that it speaks other seams."""
    shutil.copytree(LIBRARY, folder, ignore=shutil.ignore_patterns("__pycache__"))
    edit(folder / "pluto_fleet/seam.py", r"= \(\d+, \d+\), \(\d+, \d+\)", f"= {oldest}, {newest}")
    edit(folder / "pluto_fleet/__init__.py", '__version__ = ".*"', f'__version__ = "{version}"')
    return folder


def edit(file: Path, old: str, new: str) -> None:
    """Change one place in a file."""
    text, count = re.subn(old, new, file.read_text(encoding="utf-8"), count=1)
    assert count == 1, file
    file.write_text(text, encoding="utf-8")


def app_that_speaks(folder: Path, seam: str) -> Path:
    """Return a package, made to say that it speaks another seam."""
    package = compiled(NAME, folder)
    homes = [
        path
        for path in (package / "src").rglob("_runtime/**/*.py")
        if re.search(r"^SEAM = ", path.read_text("utf-8"), re.MULTILINE)
    ]
    for home in homes:
        edit(home, r"SEAM = \(\d+, \d+\)", f"SEAM = {seam}")
    return package


def test_the_library_speaks_the_seam_of_todays_apps() -> None:
    assert SEAM == NEWEST
    assert OLDEST[0] in (NEWEST[0], NEWEST[0] - 1)
    assert pluto_fleet.__version__.split(".")[:2] == [str(number) for number in NEWEST]


@pytest.mark.parametrize(
    ("oldest", "newest", "version"),
    [
        (f"({FIRST - 1}, 0)", f"({FIRST}, 3)", f"{FIRST}.3.0"),
        (f"({FIRST}, 0)", f"({FIRST + 1}, 1)", f"{FIRST + 1}.1.4"),
    ],
)
def test_an_older_app_flies_with_a_newer_library(
    oldest: str, newest: str, version: str, tmp_path: Path
) -> None:
    package = compiled(NAME, tmp_path)
    library = library_that_speaks(tmp_path / "library", oldest, newest, version)
    assert f"pluto-fleet {version}" in said(package, library, "--version").stdout
    flown = said(package, library, *SIMULATE)
    assert flown.returncode == 0, flown.stderr


@pytest.mark.parametrize("command", [SIMULATE, ("fly", "x.toml"), ("gateway",), ("--version",)])
def test_an_app_newer_than_its_library_is_refused_first_of_all(
    command: tuple[str, ...], tmp_path: Path
) -> None:
    package = app_that_speaks(tmp_path, f"({FIRST}, 4)")
    library = library_that_speaks(
        tmp_path / "library", f"({FIRST - 1}, 0)", f"({FIRST}, 2)", f"{FIRST}.2.0"
    )
    done = said(package, library, *command)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        f"drugs_distribution speaks seam {FIRST}.4,"
        f" pluto-fleet {FIRST}.2.0 speaks {FIRST - 1}.0 to {FIRST}.2:"
        f' pip install --upgrade "pluto-fleet>={FIRST}.4"\n'
    )


def test_an_app_that_is_too_old_is_told_to_be_compiled_anew(tmp_path: Path) -> None:
    package = compiled(NAME, tmp_path)
    library = library_that_speaks(
        tmp_path / "library", f"({FIRST + 1}, 0)", f"({FIRST + 2}, 0)", f"{FIRST + 2}.0.0"
    )
    done = said(package, library, *SIMULATE)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        f"drugs_distribution speaks seam {written(SEAM)},"
        f" pluto-fleet {FIRST + 2}.0.0 speaks {FIRST + 1}.0 to {FIRST + 2}.0:"
        f' compile drugs_distribution anew, or pip install "pluto-fleet<{FIRST + 2}"\n'
    )


@pytest.mark.parametrize(
    ("motion", "told"),
    [
        (STRAIGHT, {"scout": [0.5, None], "carrier": [3.0, None]}),
        (
            replace(CRAZYFLIE, limit=1.0),
            {"scout": [0.5 / PEAK, 0.5], "carrier": [1.0 / PEAK, 3.0]},
        ),
    ],
    ids=["straight", "smooth"],
)
def test_a_brain_of_seam_3_0_is_told_how_fast_its_drones_are_on_average(
    motion: Motion, told: dict[str, list[float | None]]
) -> None:
    """It knows no motion: of a fast category that is what the position controller follows."""

    class Brain:
        def __init__(self, app: object, fleet: Mapping[str, object], **_: object) -> None:
            self.fleet = fleet

    categories = (Category(name="scout", speed=0.5), Category(name="carrier", speed=3.0))
    brain: Any = SimpleNamespace(Brain=Brain)
    app = moving(replace(APP, categories=categories, brain=brain), motion)
    made: Any = app.new_brain({"drones": []}, space=Airspace())
    assert made.fleet == {"drones": [], "speeds": told}


def test_what_is_said_of_a_seam_depends_on_nothing_but_the_two() -> None:
    assert problem("some", NEWEST) is None
    assert problem("some", OLDEST) is None
    assert problem("some", (NEWEST[0], NEWEST[1] + 1)) is not None
    assert problem("some", (OLDEST[0] - 1, 9)) is not None
