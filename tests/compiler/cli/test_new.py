"""`plutoc new`: what it begins compiles and flies."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.compiler.cli.conftest import tree
from tests.kit.apps import EXAMPLES, NAMES
from tests.kit.command import plutoc


@pytest.mark.process
def test_the_commands_that_are_said_work(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As they stand there: check, run, compile."""
    said = plutoc("new", "crop_watch").out.splitlines()
    monkeypatch.chdir("crop_watch")
    commands = [line.partition("#")[0].split() for line in said if "  plutoc " in line]
    assert [command[1] for command in commands] == ["check", "run", "compile"]
    for _, *arguments in commands:
        ran = plutoc(*arguments)
        assert (ran.code, ran.err) == (0, "")


@pytest.mark.parametrize("example", NAMES)
def test_an_example_is_begun_with_under_another_name(here: Path, example: str) -> None:
    """Only its app's name is another."""
    said = plutoc("new", "greenhouse", "--from", example)
    assert (said.code, said.err) == (0, "")
    assert ("its hooks" in said.out) == (EXAMPLES / example / "hooks.py").is_file()
    files = {path: text.decode() for path, text in tree(here / "greenhouse").items()}
    source = files.pop("greenhouse.pluto")
    assert source.replace("app greenhouse ", f"app {example} ") == (
        EXAMPLES / example / "app.pluto"
    ).read_text("utf-8")
    assert files == {path: (EXAMPLES / example / path).read_text("utf-8") for path in files}
    assert plutoc("fmt", "--check", "greenhouse").code == 0


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize("example", NAMES)
def test_an_example_flies_and_compiles_under_another_name(
    here: Path, monkeypatch: pytest.MonkeyPatch, example: str
) -> None:
    """As it does under its own."""
    plutoc("new", "greenhouse", "--from", example)
    monkeypatch.chdir("greenhouse")
    flown = plutoc("run", "greenhouse.pluto")
    assert flown.code == 0, flown.out + flown.err
    assert plutoc("compile", "greenhouse.pluto").code == 0
    assert Path("greenhouse/src/greenhouse/flow.py").is_file()
