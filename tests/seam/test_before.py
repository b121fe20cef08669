"""Packages and journals from before the library: `before/` has one as the last such compiler wrote it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest

from tests.flying import EXAMPLES, compiled

NAME = "drugs_distribution_retry"
ARCHIVE = Path(__file__).parent / "before" / f"{NAME}.tar.xz"
EXAMPLE = EXAMPLES / NAME
PLAN = (str(EXAMPLE / "missions.toml"), "--fleet", str(EXAMPLE / "fleet.toml"))


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of that package."""
    folder = tmp_path_factory.mktemp("before")
    with tarfile.open(ARCHIVE) as archive:
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


def test_a_journal_from_before_is_gone_on_from(before: Path, tmp_path: Path) -> None:
    """That package's flight is stopped in the middle; the same app, compiled today, flies the rest."""
    journal = str(tmp_path / "flight.journal")
    words = [sys.executable, "-m", NAME, "fly", *PLAN, "--sim", "--speed", "20"]
    with subprocess.Popen(
        [*words, "--journal", journal], env=environment(before), stdout=subprocess.PIPE, text=True
    ) as flying:
        assert flying.stdout is not None
        for line in flying.stdout:
            if "trip" in line:
                break
        flying.send_signal(signal.SIGINT)
        flying.stdout.read()
    today = compiled(NAME, tmp_path)
    resumed = said(today, "resume", journal)
    assert resumed.returncode == 0, resumed.stderr
    assert "missions completed" in resumed.stdout.splitlines()[-1]
