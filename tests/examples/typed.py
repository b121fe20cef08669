"""What a page has its reader type, done in order, in a fresh folder; and held against what it shows.

A page shows what a reader sees in blocks of the language `console`: after `$ ` what is typed, then what
comes. Before a block a comment may say what a reader has done meanwhile, `<!-- first: sed … -->`, or that it
is only read: `<!-- needs: a browser -->`. The page says so in words, too. A `^C` is pressed once the line
above it has come; where a shell says `Killed`, the command is killed then.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from threading import Timer

from tests.paths import ROOT

_PATHS = [str(ROOT), *(str(ROOT / name) for name in ("grammar", "runtime", "stdlib_blocks"))]
_BLOCK = re.compile(
    r"(?:^<!-- (?P<what>first|needs): (?P<how>[^\n]+) -->\n)?^```console\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
_PRESSED = "^C"
_KILLED = "Killed"
_PATIENCE = 120.0
"""Seconds after which a command that does not end is interrupted: then it is not as the page says."""
_PIP = """\
#!{python}
# In place of pip, which needs a network: the same command, and the same code behind it.
import pathlib, sys
*_, what = sys.argv
assert sys.argv[1:-1] == ["install", "-e"], sys.argv
folder = pathlib.Path(what.partition("[")[0]).resolve()
program = pathlib.Path(__file__).with_name(folder.name)
program.write_text(f"#!/bin/sh\\nPYTHONPATH='{{folder}}/src' exec '{python}' -m {{folder.name}} \\"$@\\"\\n")
program.chmod(0o755)
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """A command, and what the page shows of it."""

    command: str
    shown: str
    before: str | None = None
    """What a reader has done by other means."""


def steps(text: str) -> Iterator[Step]:
    """Yield what a page has its reader type, but for what needs more than a computer."""
    for block in _BLOCK.finditer(text):
        before = block["how"] if block["what"] == "first" else None
        if block["what"] == "needs":
            continue
        for part in re.split(r"^\$ ", block["text"], flags=re.MULTILINE)[1:]:
            command, _, shown = part.partition("\n")
            yield Step(command=command, shown=shown.rstrip("\n"), before=before)
            before = None


def only_read(text: str) -> Iterator[tuple[str, str]]:
    """Yield what blocks need that are only read, and the words of the page before each."""
    for block in _BLOCK.finditer(text):
        if block["what"] == "needs":
            yield block["how"], text[: block.start()].rstrip().rpartition("\n\n")[2]


class Reader:
    """Types what the page says: in a folder, with programs that are this checkout's."""

    def __init__(self, folder: Path, programs: Path) -> None:
        self.folder = folder
        programs.mkdir()
        start = f"import sys\nsys.path[:0] = {_PATHS!r}\n"
        _program(programs / "pip", _PIP.format(python=sys.executable))
        _program(
            programs / "plutoc",
            f"#!{sys.executable}\n{start}from plutoc.cli import main\nraise SystemExit(main())\n",
        )
        kept = {n: v for n, v in os.environ.items() if not n.startswith(("PYTHON", "PLUTO"))}
        self.environment = {
            **kept,
            "PATH": os.pathsep.join([str(programs), kept["PATH"]]),
            "PYTHONUNBUFFERED": "1",
            "XDG_STATE_HOME": str(programs / "state"),
        }

    def type(self, step: Step) -> tuple[int, str]:
        """Type a command; return its exit code, and what came."""
        if step.before is not None:
            assert self.run(step.before) == (0, ""), step.before
        if step.command.startswith("cd "):
            self.folder = (self.folder / step.command.removeprefix("cd ")).resolve()
            return 0, ""
        for word, number in ((_PRESSED, signal.SIGINT), (_KILLED, signal.SIGKILL)):
            until, ended, _ = f"{step.shown}\n".partition(f"\n{word}\n")
            if ended:
                return self.run(step.command, until, number)
        return self.run(step.command)

    def run(
        self, command: str, until: str = "", number: signal.Signals = signal.SIGINT
    ) -> tuple[int, str]:
        """Run a command; signal it once so many lines have come, if the page does so."""
        lines = until.count("\n") + 1 if until else 0
        came: list[str] = []
        with subprocess.Popen(
            ["sh", "-c", f"exec {command}"],  # no shell stands between it and a Ctrl-C
            cwd=self.folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        ) as child:
            assert child.stdout is not None
            patience = Timer(_PATIENCE, child.send_signal, [signal.SIGINT])
            patience.start()
            for line in child.stdout:
                came.append(line)
                if len(came) == lines:
                    child.send_signal(number)
            patience.cancel()
        return child.returncode, "".join(came).rstrip("\n")


def is_ended(shown: str) -> bool:
    """Return whether a page has its reader end the command, so that what comes is not all of it."""
    return not {_PRESSED, _KILLED}.isdisjoint(shown.split("\n"))


def is_shown(shown: str, came: str) -> bool:
    """Return whether a page shows what came; where a command was ended, times are what they are."""
    ended = is_ended(shown)
    wanted = [line for line in _plain(shown, ended) if line not in (_PRESSED, _KILLED)]
    return wanted == _plain(came, ended)


def _plain(text: str, in_real_time: bool) -> list[str]:
    text = re.sub(r"/\S+/pluto/(\w+)/[\d-]+\.journal", r"\1.journal", text)
    if in_real_time:
        text = re.sub(r"^ +[\d.]+ s  ", "T  ", text, flags=re.MULTILINE)
    return text.split("\n")


def _program(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)
