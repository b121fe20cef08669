"""What a shell is told at TAB, asked as argcomplete's scripts for shells ask."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from plutoc.cli.options import FORMATS
from plutoc.explain.pages import codes
from plutoc_blocks import BLOCKS
from tests.kit.apps import NAMES
from tests.paths import ROOT

OURS = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}


def offered(line: str) -> list[str]:
    """Return the words that could stand at the end of a line."""
    answer = Path("..", "answer")
    asked = {
        "_ARGCOMPLETE": "3",  # the words of the program: python -m plutoc
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_STDOUT_FILENAME": os.fspath(answer),
        "COMP_LINE": f"python -m {line}",
        "COMP_POINT": str(len(f"python -m {line}")),
    }
    done = run({**OURS, **asked}, "-m", "plutoc")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    return [word.rstrip() for word in answer.read_text().splitlines()]


def run(environment: Mapping[str, str], *words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *words], env=environment, capture_output=True, text=True, check=False
    )


def test_commands_are_offered(here: Path) -> None:
    """All, or those that begin so."""
    assert {"new", "check", "compile", "diff", "explain"} <= {*offered("plutoc ")}
    assert offered("plutoc ch") == ["check"]
    assert offered("plutoc --v") == ["--version"]


def test_options_are_offered_behind_a_dash(app: Path) -> None:
    """And what they can be where there is a choice."""
    assert offered("plutoc check crop.pluto --f") == ["--fix", "--format"]
    assert offered("plutoc check --format ") == list(FORMATS)
    assert offered("plutoc compile --carry ") == ["fleet"]
    assert offered("plutoc new greenhouse --from=al") == ["--from=alfalfa"]


@pytest.mark.parametrize("command", ["check", "check a.pluto", "compile", "run", "fmt", "diff ."])
def test_apps_and_folders_are_offered_as_files(app: Path, command: str) -> None:
    """Neither what lies beside an app nor what is hidden."""
    for name in ("deep/two.pluto", "deep/er/three.pluto", ".hidden/x.pluto", "deep/notes.txt"):
        path = Path(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    assert offered(f"plutoc {command} ") == ["crop.pluto", "deep/"]
    assert offered(f"plutoc {command} deep/") == ["deep/er/", "deep/two.pluto"]
    assert offered(f"plutoc {command} .hid") == [".hidden/"]
    assert offered(f"plutoc {command} ./cr") == ["./crop.pluto"]


def test_a_folder_that_is_not_there_offers_nothing(here: Path) -> None:
    assert offered("plutoc check nowhere/") == []


def test_other_files_are_offered_where_they_belong(app: Path) -> None:
    """Missions, and folders for packages."""
    Path("out").mkdir()
    assert offered("plutoc run crop.pluto --missions ") == ["missions.toml", "out/"]
    assert offered("plutoc compile crop.pluto -o ") == ["out/"]


def test_names_are_offered_that_plutoc_knows(here: Path) -> None:
    """Kinds of blocks, codes, examples."""
    assert {*offered("plutoc blocks ")} == {block.name for block in BLOCKS}
    assert offered("plutoc blocks TimerM") == ["TimerMonitor"]
    assert offered("plutoc explain ") == list(codes())
    assert offered("plutoc explain P100") == [code for code in codes() if code.startswith("P100")]
    assert offered("plutoc new greenhouse --from ") == NAMES
    assert offered("plutoc new ") == []


def test_the_lines_of_the_page_let_a_shell_ask(app: Path) -> None:
    """bash is there; of the one for fish it is seen that there is such a script."""
    page = (ROOT / "docs/installing.md").read_text("utf-8")
    lines = dict(re.findall(r"^(\w+) +(.*register-python-argcomplete.*)$", page, re.MULTILINE))
    assert lines.keys() == {"bash", "zsh", "fish"}
    ask = 'COMP_LINE="plutoc compile "; COMP_POINT=15; _python_argcomplete plutoc; echo $COMPREPLY'
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", f"{lines['bash']}\n{ask}"],
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == "crop.pluto\n"
    command, _ = lines["fish"].split(" | ")
    script = subprocess.run(
        command.split(),
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=True,
    )
    assert "complete --command plutoc" in script.stdout


def test_other_commands_do_not_load_it(app: Path) -> None:
    """Nothing waits for what only a shell asks."""
    code = (
        "import sys; from plutoc.cli import main; main(['check', 'crop.pluto']);"
        "print([name for name in sys.modules if 'complet' in name], file=sys.stderr)"
    )
    assert run(OURS, "-c", code).stderr == "[]\n"


def test_without_argcomplete_a_shell_is_offered_nothing(here: Path) -> None:
    """A script for shells may be there for other programs; no command is run by it."""
    code = (
        "import importlib.util, sys; from plutoc.cli import main\n"
        "importlib.util.find_spec = lambda name: None\n"
        "sys.exit(main([]))\n"
    )
    done = run({**OURS, "_ARGCOMPLETE": "1", "COMP_LINE": "plutoc ", "COMP_POINT": "7"}, "-c", code)
    assert (done.returncode, done.stdout) == (2, "")
