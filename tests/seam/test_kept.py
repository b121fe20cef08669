"""Today's library flies packages of each seam that it speaks, and those from before there was a library."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from pluto_fleet.seam import NEWEST, written
from tests.flying import compiled
from tests.seam.packages import BEFORE, NAME, PLAN, SEAMS, begun, environment, said, unpacked


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of that package."""
    return unpacked(BEFORE, tmp_path_factory.mktemp("before"))


@pytest.mark.long  # nothing of it changes but Python
def test_a_package_from_before_still_flies_alone(before: Path, tmp_path: Path) -> None:
    """It has all that it needs, and takes nothing of the library that is beside it now."""
    journal = str(tmp_path / "flight.journal")
    flown = said(before, "fly", *PLAN, "--sim", "--speed", "200", "--journal", journal)
    assert flown.returncode == 0, flown.stderr
    assert "missions completed" in flown.stdout.splitlines()[-1]
    code = f"import sys, {NAME}.flow, {NAME}._runtime.cli.simulate; print(*sys.modules)"
    modules = subprocess.run(
        [sys.executable, "-c", code],
        env=environment(before),
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    assert f"{NAME}._runtime.session" in modules
    assert "pluto_fleet" not in modules


@pytest.mark.long  # a whole flight; of newer seams it is always seen
def test_a_journal_from_before_is_gone_on_from(before: Path, tmp_path: Path) -> None:
    """That package's flight is stopped in the middle; the same app, compiled today, flies the rest."""
    journal = tmp_path / "flight.journal"
    with begun(before, journal) as flying:
        flying.send_signal(signal.SIGINT)
    resumed = said(compiled(NAME, tmp_path), "resume", str(journal))
    assert resumed.returncode == 0, resumed.stderr
    assert "missions completed" in resumed.stdout.splitlines()[-1]


def test_a_package_of_every_seam_is_kept() -> None:
    """Todays too: tomorrow it is an old one."""
    assert written(NEWEST) in SEAMS


@pytest.mark.parametrize("seam", SEAMS)
def test_it_is_flown(seam: str, tmp_path: Path) -> None:
    package = unpacked(seam, tmp_path)
    assert f"seam {seam}," in said(package, "--version").stdout
    assert said(package, "simulate", *PLAN).returncode == 0
    journal = str(tmp_path / "flight.journal")
    flown = said(package, "fly", *PLAN, "--sim", "--speed", "200", "--journal", journal)
    assert flown.returncode == 0, flown.stderr


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGKILL], ids=["stopped", "killed"])
@pytest.mark.parametrize("seam", SEAMS)
def test_it_is_resumed(seam: str, end: signal.Signals, tmp_path: Path) -> None:
    package, journal = unpacked(seam, tmp_path), tmp_path / "flight.journal"
    with begun(package, journal) as flying:
        flying.send_signal(end)
    resumed = said(package, "resume", str(journal))
    assert resumed.returncode == 0, resumed.stderr
    assert "missions completed" in resumed.stdout.splitlines()[-1]
