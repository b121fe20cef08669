"""Today's library flies a package of each seam that it speaks, as that was compiled then."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest

from pluto_fleet.seam import NEWEST, written
from tests.seam.packages import PLAN, SEAMS, begun, said, unpacked


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
