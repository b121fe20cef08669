"""What a shell is told at TAB, asked as argcomplete's scripts for shells ask."""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path

import pytest

from plutoc.cli.options import FORMATS
from plutoc.explain.pages import codes
from plutoc_blocks import BLOCKS
from tests.kit.apps import NAMES
from tests.kit.command import command, python
from tests.paths import ROOT

ASKS = r"""
import json, os, sys
from plutoc.cli import main

def offered(line):
    if not (child := os.fork()):
        os.environ.update(
            _ARGCOMPLETE="1", _ARGCOMPLETE_IFS="\n", _ARGCOMPLETE_STDOUT_FILENAME="../answer",
            COMP_LINE=line, COMP_POINT=str(len(line)),
        )
        os._exit(main([]))
    assert os.waitpid(child, 0)[1] == 0
    return [word.rstrip() for word in open("../answer").read().splitlines()]

print(json.dumps([offered(line) for line in json.load(sys.stdin)]))
"""
"""A process that answers for many lines, each in a fork, for an answer ends the process."""

FILES = ["crop.pluto", "deep/", "out/"]
OFFERED = {
    "plutoc ch": ["check"],
    "plutoc --v": ["--version"],
    "plutoc check crop.pluto --f": ["--fix", "--format"],
    "plutoc check --format ": list(FORMATS),
    "plutoc compile --carry ": ["fleet"],
    "plutoc new greenhouse --from=al": ["--from=alfalfa"],
    "plutoc new greenhouse --from ": NAMES,
    "plutoc new ": [],
    **{f"plutoc {words} ": FILES for words in ("check", "compile", "run", "fmt", "diff .")},
    "plutoc check a.pluto ": FILES,
    "plutoc check deep/": ["deep/er/", "deep/two.pluto"],
    "plutoc check .hid": [".hidden/"],
    "plutoc check ./cr": ["./crop.pluto"],
    "plutoc check nowhere/": [],
    "plutoc run crop.pluto --missions ": ["deep/", "missions.toml", "out/"],
    "plutoc compile crop.pluto -o ": ["deep/", "out/"],
    "plutoc blocks TimerM": ["TimerMonitor"],
    "plutoc blocks ": sorted(block.name for block in BLOCKS),
    "plutoc explain ": list(codes()),
    "plutoc explain P100": [code for code in codes() if code.startswith("P100")],
}
"""What is offered behind each line; apps as files, neither what lies beside them nor what is hidden."""


@pytest.mark.process
def test_what_can_come_next_is_offered(app: Path) -> None:
    """Commands, options behind a dash, files where they belong, and names that plutoc knows."""
    for name in ("deep/two.pluto", "deep/er/three.pluto", ".hidden/x.pluto", "deep/notes.txt"):
        path = Path(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    Path("out").mkdir()
    done = python("-c", ASKS, given=json.dumps([*OFFERED, "plutoc "]))
    assert done.err == ""
    *answers, commands = json.loads(done.out)
    assert {line: sorted(words) for line, words in zip(OFFERED, answers, strict=True)} == {
        line: sorted(words) for line, words in OFFERED.items()
    }
    assert {"new", "check", "compile", "diff", "explain"} <= {*commands}


@pytest.mark.long
@pytest.mark.process
def test_the_lines_of_the_page_let_a_shell_ask(app: Path) -> None:
    """bash is there; of the one for fish it is seen that there is such a script."""
    page = (ROOT / "docs/installing.md").read_text("utf-8")
    lines = dict(re.findall(r"^(\w+) +(.*register-python-argcomplete.*)$", page, re.MULTILINE))
    assert lines.keys() == {"bash", "zsh", "fish"}
    ask = 'COMP_LINE="plutoc compile "; COMP_POINT=15; _python_argcomplete plutoc; echo $COMPREPLY'
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = command("bash", "-c", f"{lines['bash']}\n{ask}", PATH=path)
    assert (done.code, done.out) == (0, "crop.pluto\n")
    script = command("bash", "-c", lines["fish"].split(" | ")[0], PATH=path)
    assert "complete --command plutoc" in script.out
