"""Packages as they were compiled when their seam was the newest: today's library must fly them all.

`python -m tests.seam.packages` keeps those of today's seam, once it is settled; with names only these.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
from argparse import ArgumentParser
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from pluto_fleet.seam import written
from pluto_fleet.shared.domain.app import SEAM
from tests.kit.apps import EXAMPLES, compiled_file

HERE = Path(__file__).parent
NAME, WITH_HOOKS = "drugs_distribution_retry", "watered_garden"
SOURCES = {NAME: EXAMPLES / NAME, WITH_HOOKS: HERE / WITH_HOOKS}
"""The apps that are kept, and the folders with their sources, missions and fleets."""
BEFORE = "before"
"""The last package that carried everything, and knows of no seam; it reads its own, older fleet."""


@dataclass(frozen=True)
class Kept:
    """An app that is kept of a seam."""

    seam: str
    name: str

    def __str__(self) -> str:
        return f"{self.seam}-{self.name}"


KEPT = sorted(
    (Kept(path.parent.name, path.name.partition(".")[0]) for path in HERE.glob("*.*/*.tar.xz")),
    key=str,
)
SEAMS = sorted({kept.seam for kept in KEPT})


def plan(name: str, home: Path | None = None) -> tuple[str, ...]:
    """Return the missions and the fleet of an app, as words of a command line; `home` is the fleet's."""
    fleet = (home or SOURCES[name]) / "fleet.toml"
    return (str(SOURCES[name] / "missions.toml"), "--fleet", str(fleet))


def unpacked(kept: Kept, folder: Path) -> Path:
    """Return the folder of the package that is kept of a seam."""
    with tarfile.open(HERE / kept.seam / f"{kept.name}.tar.xz") as archive:
        archive.extractall(folder, filter="data")
    return folder / kept.name


WATCHED = HERE.parent / "library/watched"
"""A folder with what makes every Python watch its imports."""


def environment(package: Path) -> dict[str, str]:
    """Return one in which this package is found first, and what the library imports is written down."""
    path = os.pathsep.join((str(package / "src"), str(WATCHED)))
    return {**os.environ, "PYTHONPATH": path, "PLUTO_IMPORTS": str(package / "imports.txt")}


def imported(package: Path) -> set[str]:
    """Return which modules of the package's `_runtime` the library has imported, and where."""
    try:
        return set((package / "imports.txt").read_text(encoding="utf-8").splitlines())
    except FileNotFoundError:
        return set()


def said(package: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run a command of a package to its end."""
    command = [sys.executable, "-m", package.name, *words]
    return subprocess.run(
        command, env=environment(package), capture_output=True, text=True, check=False
    )


def begun(
    package: Path, journal: Path, until: str = "launched", home: Path | None = None
) -> subprocess.Popen[str]:
    """Begin a flight, and return its process when it says this; at first: when the first trip flies."""
    words = [sys.executable, "-m", package.name, "fly", *plan(package.name, home)]
    flying = subprocess.Popen(
        [*words, "--sim", "--speed", "50", "--journal", str(journal)],
        env=environment(package),
        stdout=subprocess.PIPE,
        text=True,
    )
    assert flying.stdout is not None
    for line in flying.stdout:
        if until in line:
            break
    return flying


def keep(names: Sequence[str]) -> None:
    """Keep packages of today's seam."""
    home = HERE / written(SEAM)
    home.mkdir(exist_ok=True)
    for name in names:
        with TemporaryDirectory() as folder, tarfile.open(home / f"{name}.tar.xz", "w:xz") as kept:
            package = compiled_file(SOURCES[name] / "app.pluto", Path(folder, name))
            kept.add(package, name, filter=_plain)


def _plain(one: tarfile.TarInfo) -> tarfile.TarInfo:
    """Leave out when and by whom it was made."""
    one.mtime = one.uid = one.gid = 0
    one.uname = one.gname = ""
    return one


if __name__ == "__main__":
    parser = ArgumentParser(prog="python -m tests.seam.packages", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all")
    given = parser.parse_args().names or list(SOURCES)
    if unknown := sorted(set(given) - set(SOURCES)):
        parser.error(f"no such app: {', '.join(unknown)} (there are {', '.join(SOURCES)})")
    keep(given)
