"""What docs/ci/github-diff.yml offers to copy does what docs/diff.md says."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from tests.compiler.diff.pairs import EXAMPLES, edited
from tests.paths import ROOT

pytestmark = pytest.mark.long  # real repositories, and the shell of the workflow

OLD = EXAMPLES["alfalfa"]
NEW = edited(OLD, ("max_attempts: 3", "max_attempts: 5"))


@pytest.fixture
def pull_request(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with two commits, and a `plutoc` of this checkout."""
    programs, work = tmp_path / "programs", tmp_path / "work"
    programs.mkdir()
    work.mkdir()
    (programs / "plutoc").write_text(f"#!/bin/sh\nexec '{sys.executable}' -m plutoc \"$@\"\n")
    (programs / "plutoc").chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(tmp_path / "summary.md"))
    monkeypatch.chdir(work)
    return work


def commit(texts: dict[str, str]) -> None:
    """Commit these files."""
    for name, text in texts.items():
        Path(name).write_text(text)
    for command in (
        ["init", "-q"],
        ["add", "."],
        ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-q", "-m", "a"],
    ):
        subprocess.run(["git", *command], check=True)


def said() -> str:
    """Run the step, and return what it wrote for the comment, and into the summary."""
    workflow = YAML(typ="safe").load(ROOT / "docs/ci/github-diff.yml")
    steps = workflow["jobs"]["diff"]["steps"]
    (command,) = (step["run"] for step in steps if step.get("name") == "Say what changes")
    subprocess.run(["bash", "-eo", "pipefail", "-c", command], check=True)
    summary = Path(os.environ["GITHUB_STEP_SUMMARY"]).read_text()
    assert summary == Path("changes.md").read_text()
    return summary


def test_each_app_that_changed_is_compared(pull_request: Path) -> None:
    """Also one whose name looks like an option; new ones have nothing to be compared with."""
    commit({"-o.pluto": OLD, "same.pluto": OLD, "b c.pluto": OLD})
    commit({"-o.pluto": NEW, "b c.pluto": f"{OLD}# A comment.\n", "new.pluto": OLD})
    report = said()
    assert "### `-o.pluto`: 1 change in meaning" in report
    assert "- a FAILED mission is now retried up to 5 times" in report
    assert "### `b c.pluto`: nothing changed in meaning" in report
    assert "same.pluto" not in report and "new.pluto" not in report


def test_an_app_with_errors_does_not_hide_the_others(pull_request: Path) -> None:
    """It is said that there is one."""
    commit({"a.pluto": OLD, "b.pluto": OLD})
    commit({"a.pluto": OLD.replace("TripLauncher", "TripLaunch"), "b.pluto": NEW})
    report = said()
    assert "An app was not compared" in report
    assert "### `b.pluto`: 1 change in meaning" in report
