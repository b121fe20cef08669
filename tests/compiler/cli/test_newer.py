"""An older plutoc over a package that a newer one made."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from plutoc import __version__
from tests.compiler.cli.conftest import APP, Call, tree

LOCK, HOOKS = Path("crop/pluto.lock"), Path("crop/src/crop/hooks.py")
SENTENCE = (
    f"`crop` was made by plutoc 999.0, which is newer than this plutoc {__version__}: upgrade"
    f" plutoc, or go back to {__version__} on purpose with `--force`"
)
OURS = f'plutoc = "{__version__}"'
LATER = """[lock]
format = 2

[versions]
plutoc = "999.0"

[[file]]
path = "src/crop/flow.py"
blake3 = "6437b3ac38465133ffb63b75273a8db548c558465d79db03fd359c6cd5bd9d85"
"""
"""As a later version might write it."""


@pytest.fixture(params=["a version", "another format", "a merge"])
def newer(request: pytest.FixtureRequest, plutoc: Call, app: Path) -> Path:
    """A package of a newer compiler's, and an app that has been edited since."""
    assert plutoc("compile", app).code == 0
    text = LOCK.read_text()
    match request.param:
        case "a version":
            text = text.replace(OURS, 'plutoc = "999.0"')
        case "another format":
            text = LATER
        case _:
            both = f'<<<<<<< HEAD\n{OURS}\n=======\nplutoc = "999.0"\n>>>>>>> theirs'
            text = text.replace(OURS, both)
    LOCK.write_text(text)
    app.write_text(APP.replace("max_attempts: 3", "max_attempts: 5"))
    return app


def typed(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Run the compiler in a process of its own."""
    command = [sys.executable, "-m", "plutoc", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("more", [[], ["--check"], ["--diff"], ["--add-stubs"], ["-O0"]])
def test_it_is_refused_with_3_in_one_sentence(
    plutoc: Call, newer: Path, here: Path, more: list[str]
) -> None:
    """Both versions are named, and both ways out of it; nothing is written."""
    before = tree(here)
    said = plutoc("compile", newer, *more)
    assert (said.code, said.out) == (3, "")
    assert said.err.startswith(f"error[P4010]: {SENTENCE}\n")
    assert "1 error\n" in said.err
    assert tree(here) == before


def test_a_program_is_told_the_same(newer: Path) -> None:
    """On standard output, with the same exit code, by a process of its own."""
    done = typed("compile", newer, "--check", "--format", "json")
    assert (done.returncode, done.stderr) == (3, "")
    (found,) = map(json.loads, done.stdout.splitlines())
    assert (found["code"], found["message"]) == ("P4010", SENTENCE)


def test_what_the_older_one_would_say_of_the_hooks_comes_later(plutoc: Call, newer: Path) -> None:
    """A newer one may ask for other hooks: to change these would be wrong."""
    HOOKS.write_text("")
    said = plutoc("compile", newer)
    assert said.code == 3
    assert "P3003" not in said.err


def test_one_goes_back_on_purpose(plutoc: Call, newer: Path) -> None:
    """Then the package is what this version makes, and hooks.py is as it was."""
    mine = HOOKS.read_text() + "# mine\n"
    HOOKS.write_text(mine)
    assert plutoc("compile", newer, "--force").code == 0
    assert OURS in LOCK.read_text()
    assert HOOKS.read_text() == mine
    assert plutoc("compile", newer, "--check").code == 0
    assert plutoc("compile", newer, "-o", "fresh").code == 0
    assert LOCK.read_text() == Path("fresh/pluto.lock").read_text()
