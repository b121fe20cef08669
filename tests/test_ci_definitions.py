"""What docs/ci offers to copy does what it says, on an example that is sound and on ones that are not."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from ruamel.yaml import YAML

from tests.paths import ROOT

CI = ROOT / "docs" / "ci"
APP = Path("warehouse/app.pluto")
FORM, SOUND, PACKAGE = (
    "Pluto sources are in canonical form",
    "Pluto apps are sound",
    "Generated packages are what their apps say",
)
STEPS = {
    FORM: "Sources are in canonical form",
    SOUND: "Apps are sound",
    PACKAGE: "Generated packages are what their apps say",
}
FINDINGS = "Findings for code scanning"


class Hook(NamedTuple):
    """A hook of pre-commit."""

    entry: str
    files: str
    pass_filenames: bool


def hooks() -> dict[str, Hook]:
    """Return the hooks that are offered, by their names."""
    (repo,) = YAML(typ="safe").load(CI / "pre-commit-config.yaml")["repos"]
    assert repo["repo"] == "local"
    assert {hook["language"] for hook in repo["hooks"]} == {"system"}
    return {
        hook["name"]: Hook(hook["entry"], hook["files"], hook.get("pass_filenames", True))
        for hook in repo["hooks"]
    }


def steps() -> dict[str, str]:
    """Return the commands of the workflow's steps, by their names."""
    workflow = YAML(typ="safe").load(CI / "github-action.yml")
    assert workflow["on"].keys() == {"push", "pull_request"}
    (job,) = workflow["jobs"].values()
    return {step["name"]: step["run"] for step in job["steps"] if "run" in step}


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A repository with an app and its package, and a `plutoc` of this checkout."""
    folder = tmp_path_factory.mktemp("sound") / "work"
    programs = tmp_path_factory.mktemp("programs")
    (programs / "plutoc").write_text(f"#!/bin/sh\nexec '{sys.executable}' -m plutoc \"$@\"\n")
    (programs / "plutoc").chmod(0o755)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")
        patch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
        shutil.copytree(ROOT / "examples/warehouse_item_finder", folder / APP.parent)
        done = run(folder, f"plutoc compile {APP} && git init -q && git add .")
        assert done.returncode == 0, done.stderr
        yield folder


@pytest.fixture
def project(sound: Path, tmp_path: Path) -> Path:
    """A clone of it, to make mistakes in."""
    return Path(shutil.copytree(sound, tmp_path / "work"))


def run(folder: Path, *command: str) -> subprocess.CompletedProcess[str]:
    """Run a command as GitHub's shell would, or a whole list of arguments."""
    arguments = ["bash", "-eo", "pipefail", "-c", *command] if len(command) == 1 else command
    return subprocess.run(arguments, cwd=folder, capture_output=True, text=True, check=False)


def committed(folder: Path, name: str) -> int:
    """Return how one of the hooks ends, called as pre-commit calls it."""
    hook = hooks()[name]
    listed = run(folder, "git", "ls-files").stdout.splitlines()
    files = [path for path in listed if re.search(hook.files, path)]
    assert str(APP) in files
    return run(folder, *shlex.split(hook.entry), *(files if hook.pass_filenames else [])).returncode


def levels(folder: Path) -> list[str]:
    """Return how bad each of the findings is that would be uploaded."""
    (found,) = json.loads((folder / "plutoc.sarif").read_text())["runs"]
    return [result["level"] for result in found["results"]]


def test_the_two_ask_the_same_questions() -> None:
    """A commit is told what CI would say."""
    assert list(hooks()) == list(STEPS)
    assert {*STEPS.values(), FINDINGS} <= steps().keys()


@pytest.mark.long
def test_a_sound_project_passes_all_of_them(project: Path) -> None:
    """And the findings for code scanning are there: a warning."""
    for name in STEPS:
        assert committed(project, name) == 0
        assert run(project, steps()[STEPS[name]]).returncode == 0
    assert run(project, steps()[FINDINGS]).returncode == 0
    assert levels(project) == ["warning"]


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        (FORM, "policy: weakest_first", "policy:weakest_first"),
        (SOUND, "watch -> end otherwise", "watch -> end when FAILED, STANDBY"),
        (PACKAGE, "30 min", "20 min"),
    ],
)
def test_a_mistake_is_found_before_a_commit_and_in_ci(
    project: Path, name: str, old: str, new: str
) -> None:
    app = project / APP
    text = app.read_text()
    assert old in text
    app.write_text(text.replace(old, new))
    assert committed(project, name) != 0
    assert run(project, steps()[STEPS[name]]).returncode != 0


@pytest.mark.long
@pytest.mark.parametrize("name", ["--fix.pluto", "-o.pluto"])
def test_a_file_that_looks_like_an_option_is_a_file(project: Path, name: str) -> None:
    """The author of a change chooses the names in it."""
    shutil.copy(project / APP, project / name)
    assert run(project, "git", "add", "--", name).returncode == 0
    for one in (FORM, SOUND):
        assert committed(project, one) == 0
        assert run(project, steps()[STEPS[one]]).returncode == 0
    assert run(project, steps()[FINDINGS]).returncode == 0


@pytest.mark.long
def test_findings_are_uploaded_though_there_are_errors(project: Path) -> None:
    """The step that writes them passes: another one has failed."""
    app = project / APP
    app.write_text(app.read_text().replace("TripLauncher", "TripLaunch"))
    assert run(project, steps()[FINDINGS]).returncode == 0
    result, *_ = json.loads((project / "plutoc.sarif").read_text())["runs"][0]["results"]
    assert result["level"] == "error"


def test_what_the_page_offers_is_there() -> None:
    """Every file of docs/ci is linked from docs/ci.md, and every link leads to a file."""
    page = (ROOT / "docs/ci.md").read_text()
    linked = set(re.findall(r"\]\((ci/[^)]+)\)", page))
    assert linked == {f"ci/{path.name}" for path in CI.iterdir()}
