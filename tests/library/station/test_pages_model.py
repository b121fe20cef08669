"""The pages as front-end engineers check them: types, style, and tests of what they compute."""

from __future__ import annotations

import os
import shutil
import subprocess

import pytest

from tests.paths import ROOT

RUNTIME = ROOT / "runtime"
STEPS = ("types", "lint", "test")


@pytest.fixture(scope="session")
def npm(tmp_path_factory: pytest.TempPathFactory) -> str:
    """npm, with the tools of the pages installed."""
    found = shutil.which("npm")
    if found is None and os.environ.get("CI"):
        pytest.fail("npm is not on the path")
    if found is None:
        pytest.skip("npm is not on the path")
    if not (RUNTIME / "node_modules" / ".package-lock.json").exists():
        words = [found, "ci", "--ignore-scripts", "--no-audit", "--no-fund"]
        subprocess.run(words, cwd=RUNTIME, check=True, capture_output=True)
    return found


@pytest.mark.xdist_group("pages")
@pytest.mark.parametrize("step", STEPS)
def test_pages_are_typed_clean_and_tested(npm: str, step: str) -> None:
    """A step of what the pages' own engineers run finds nothing."""
    done = subprocess.run(
        [npm, "run", "-s", step], check=False, cwd=RUNTIME, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
