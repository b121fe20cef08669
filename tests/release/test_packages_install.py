"""Every example becomes a package that stands alone: installed in a fresh environment, it flies."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from tests.release.environments import ROOT, compile_app, fresh, succeed

EXAMPLES = sorted(path.parent for path in ROOT.glob("examples/*/app.pluto"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_an_example_installs_alone_is_clean_and_completes_its_missions(
    example: Path, tmp_path: Path
) -> None:
    package = compile_app(example / "app.pluto", tmp_path / example.name)
    programs = fresh(tmp_path / "venv")
    before = installed(programs)
    succeed(programs / "pip", "install", "--quiet", package)
    assert installed(programs) - before == {example.name.replace("_", "-")}

    plan: list[str | Path] = [example / "missions.toml", "--fleet", example / "fleet.toml"]
    flown = json.loads(succeed(programs / example.name, "simulate", *plan, "--json"))
    assert {mission["status"] for mission in flown["missions"]} == {"COMPLETED"}
    assert succeed(programs / example.name, "check", *plan)

    python = sys.executable
    succeed(python, "-m", "mypy", "--strict", "src", "tests", cwd=package)
    succeed(python, "-m", "ruff", "check", "--isolated", ".", cwd=package)
    ignores = ("type: ignore", "noqa")
    assert not [
        path for path in package.rglob("*.py") for word in ignores if word in path.read_text()
    ]


def installed(programs: Path) -> set[str]:
    """The names of what is installed."""
    listed = json.loads(succeed(programs / "pip", "list", "--format", "json"))
    return {entry["name"].lower().replace("_", "-") for entry in listed}
