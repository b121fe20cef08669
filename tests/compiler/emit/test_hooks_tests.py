"""Generated tests hold for any hooks.py, and a package's types are told to who uses it wrongly."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from plutoc.emit.package import emit
from tests.compiler.emit.apps import ODD_NAMES, PARCELS, TYPED
from tests.compiler.emit.plans import plan_of
from tests.kit.apps import compiled
from tests.kit.sections import given
from tests.paths import EXAMPLES

pytestmark = pytest.mark.long

HERE = Path(__file__).parent
WITH_HOOKS = sorted(path.parent.name for path in EXAMPLES.glob("*/hooks.py"))
STUBS = {"odd": ODD_NAMES, "parcels": PARCELS, "typed": TYPED, **given(HERE / "stubs.txt")}
EXPECTED = re.compile(r"  # (note|error): (.+)$")


def written(text: str, folder: Path) -> Path:
    """Write an app's package as it is first compiled, and return its folder."""
    package = emit(plan_of(text), source_name="app.pluto", picture="flowchart TD\n")
    for path, file in {**package.owned, **package.once}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(file, encoding="utf-8")
    return folder


def run(folder: Path, *command: str) -> str:
    """Run Python in a package's folder, and return what it printed."""
    environment = {**os.environ, "PYTHONPATH": "src", "MYPYPATH": "src"}
    done = subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        env={**environment, "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout + done.stderr


PYTEST = ("-m", "pytest", "-q", "-p", "no:cacheprovider", "tests")


@pytest.mark.parametrize("text", STUBS.values(), ids=list(STUBS))
def test_stubs_pass(text: str, tmp_path: Path) -> None:
    """Under any names, in every place that a hook can have; and the package flies as it is."""
    assert re.search(r"^\d+ passed", run(written(text, tmp_path), *PYTEST), re.MULTILINE)


@pytest.mark.parametrize("name", WITH_HOOKS)
def test_they_hold_for_hooks_that_are_written(name: str, tmp_path: Path) -> None:
    """A hooks.py beside the app becomes the package's, and the tests are none the wiser."""
    assert re.search(r"^\d+ passed", run(compiled(name, tmp_path), *PYTEST), re.MULTILINE)


def test_what_an_app_declares_a_type_checker_knows(tmp_path: Path) -> None:
    """Of fields, parameters and results; each line of `wrong_uses.txt` says what is told of it."""
    folder = written(TYPED, tmp_path)
    uses = (HERE / "wrong_uses.txt").read_text(encoding="utf-8")
    (folder / "tests/wrong.py").write_text(uses, encoding="utf-8")
    told = run(folder, "-m", "mypy", "--strict", f"--cache-dir={os.devnull}", "src", "tests")
    said = [line for line in told.replace("builtins.", "").splitlines() if "wrong.py" in line]
    for number, line in enumerate(uses.splitlines(), start=1):
        mine = [each for each in said if each.startswith(f"tests/wrong.py:{number}: ")]
        if wanted := EXPECTED.search(line):
            assert any(f" {wanted[1]}: {wanted[2]}" in each for each in mine), told
        else:
            assert not mine
