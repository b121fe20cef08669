"""Packages as they were compiled when their seam was the newest: today's library must fly them all.

`python -m tests.seam.packages` keeps one of today's seam, once it is settled.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
from pathlib import Path
from tempfile import TemporaryDirectory

from pluto_fleet.seam import written
from plutoc_runtime.command import SEAM
from tests.flying import EXAMPLES, compiled

HERE = Path(__file__).parent
NAME = "drugs_distribution_retry"
EXAMPLE = EXAMPLES / NAME
PLAN = (str(EXAMPLE / "missions.toml"), "--fleet", str(EXAMPLE / "fleet.toml"))
BEFORE = "before"
"""The last package that carried everything, and knows of no seam."""
SEAMS = sorted(path.parent.name for path in HERE.glob(f"*.*/{NAME}.tar.xz"))


def unpacked(seam: str, folder: Path) -> Path:
    """Return the folder of the package that is kept of a seam."""
    with tarfile.open(HERE / seam / f"{NAME}.tar.xz") as archive:
        archive.extractall(folder, filter="data")
    return folder / NAME


def environment(package: Path) -> dict[str, str]:
    """Return one in which this package is found first."""
    return {**os.environ, "PYTHONPATH": str(package / "src")}


def said(package: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run a command of a package to its end."""
    command = [sys.executable, "-m", NAME, *words]
    return subprocess.run(
        command, env=environment(package), capture_output=True, text=True, check=False
    )


def begun(package: Path, journal: Path) -> subprocess.Popen[str]:
    """Begin a flight, and return its process when the first trip flies."""
    words = [sys.executable, "-m", NAME, "fly", *PLAN, "--sim", "--speed", "20"]
    flying = subprocess.Popen(
        [*words, "--journal", str(journal)],
        env=environment(package),
        stdout=subprocess.PIPE,
        text=True,
    )
    assert flying.stdout is not None
    for line in flying.stdout:
        if "launched" in line:
            break
    return flying


def keep() -> None:
    """Keep a package of today's seam."""
    archive = HERE / written(SEAM) / f"{NAME}.tar.xz"
    archive.parent.mkdir(exist_ok=True)
    with TemporaryDirectory() as folder, tarfile.open(archive, "w:xz") as kept:
        kept.add(compiled(NAME, Path(folder)), NAME, filter=_plain)


def _plain(one: tarfile.TarInfo) -> tarfile.TarInfo:
    """Leave out when and by whom it was made."""
    one.mtime = one.uid = one.gid = 0
    one.uname = one.gname = ""
    return one


if __name__ == "__main__":
    keep()
