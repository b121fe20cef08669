"""Generated tests hold for any hooks.py, and a package's types are told to who uses it wrongly."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from plutoc.emit.package import emit
from tests.compiler.emit.apps import EVENTS, ODD_NAMES, PARCELS, TYPED
from tests.compiler.emit.plans import plan_of
from tests.kit.command import python
from tests.kit.sections import given

pytestmark = pytest.mark.long

HERE = Path(__file__).parent
STUBS = {
    "odd": ODD_NAMES,
    "parcels": PARCELS,
    "typed": TYPED,
    "events": EVENTS,
    **given(HERE / "stubs.txt"),
}
EXPECTED = re.compile(r"  # (note|error): (.+)$")


def written(text: str, folder: Path) -> Path:
    """Write an app's package as it is first compiled, and return its folder."""
    package = emit(plan_of(text), source_name="app.pluto", picture="flowchart TD\n", graph_data="")
    for path, file in {**package.owned, **package.once}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(file, encoding="utf-8")
    return folder


def run(folder: Path, *words: str) -> str:
    """Run Python in a package's folder, and return what it printed."""
    done = python(*words, cwd=folder, PYTHONPATH="src", MYPYPATH="src")
    return done.out + done.err


PYTEST = ("-m", "pytest", "-q", "-p", "no:cacheprovider", "tests")


@pytest.mark.parametrize("text", STUBS.values(), ids=list(STUBS))
def test_stubs_pass(text: str, tmp_path: Path) -> None:
    """Under any names, in every place that a hook can have; and the package flies as it is."""
    assert re.search(r"^\d+ passed", run(written(text, tmp_path), *PYTEST), re.MULTILINE)


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
