"""`python -m tests --help` lists what there is, and nothing that is not there."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.__main__ import CAMPAIGNS, MEASURES, REWRITES, listing
from tests.paths import ROOT


def test_every_command_names_something_that_is_there() -> None:
    """A module of the tests, or a file."""
    for command in [*REWRITES, *CAMPAIGNS, *MEASURES]:
        target = next(word for word in command.split()[1:] if word != "-m")
        if command.startswith("python -m"):
            place = ROOT / target.replace(".", "/")
            assert place.with_suffix(".py").is_file() or (place / "__main__.py").is_file(), command
        else:
            assert (ROOT / target).exists(), command


@pytest.mark.parametrize("module", sorted({command.split()[2] for command in CAMPAIGNS}))
def test_a_campaign_runs_from_the_checkout_and_says_what_it_is_for(module: str) -> None:
    asked = [sys.executable, "-m", module, "--help"]
    done = subprocess.run(asked, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "usage: " in done.stdout


def test_every_measure_is_listed() -> None:
    """Every script of the benchmarks that can be run."""
    scripts = [
        path.name
        for path in (ROOT / "benchmarks").glob("*.py")
        if '__name__ == "__main__"' in path.read_text(encoding="utf-8")
    ]
    assert sorted(scripts) == sorted(command.split("/")[-1] for command in MEASURES)
    assert "python -m tests.equivalence" in listing()
