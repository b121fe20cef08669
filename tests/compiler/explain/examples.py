"""The examples of a page, and what the compiler says of them."""

from __future__ import annotations

import contextlib
import json
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from plutoc.cli import main
from plutoc.explain.pages import page
from tests.paths import ROOT

CODE = re.compile(r"\bP\d{4}\b")
WITHOUT_EXAMPLES = ("P2026", "P9001")
"""An app with so many states has more blocks than a page has lines; and no one can write one that
makes the compiler break: else it would be mended."""

_FENCED = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_SECTION = re.compile(r"^## (.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)
_FILES = {"pluto": "app.pluto", "python": "hooks.py"}
_PATHS = [str(ROOT), *(str(ROOT / name) for name in ("grammar", "runtime", "stdlib_blocks"))]


@dataclass(frozen=True, slots=True, kw_only=True)
class Example:
    """The files of an example by their names, and what is to be typed, if that shows more."""

    files: dict[str, str]
    console: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Typed:
    """A command, and the lines of its output that the page shows."""

    command: str
    shown: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Ended:
    """What a command ended with, and what it printed."""

    code: int
    said: str


def headings(code: str) -> list[str]:
    """Return the headings below a page's title."""
    return re.findall(r"^## (.+)$", page(code).text, re.MULTILINE)


def example(code: str, *, mended: bool) -> Example:
    """Return an example of a page; a file that the second does not show is as in the first."""
    files: dict[str, str] = {}
    for section in _SECTION.findall(page(code).text)[: 1 + mended]:
        blocks = _FENCED.findall(section)
        assert len({language for language, _ in blocks}) == len(blocks), f"{code}: {section}"
        console = dict(blocks).get("console")
        files |= {_FILES[language]: text for language, text in blocks if language != "console"}
    return Example(files=files, console=console)


def said_of(
    shown: Example, folder: Path, capfd: pytest.CaptureFixture[str]
) -> set[tuple[str, str]]:
    """Check an example in this process; return the severity and the code of each finding."""
    write(shown, folder)
    capfd.readouterr()
    main(["check", str(folder / "app.pluto"), "--format", "json"])
    said = capfd.readouterr()
    assert not said.err
    found = map(json.loads, said.out.splitlines())
    return {(finding["severity"], finding["code"]) for finding in found}


def write(shown: Example, folder: Path) -> None:
    """Put the files of an example into a folder."""
    for name, text in shown.files.items():
        (folder / name).write_text(text, encoding="utf-8")


def typed(console: str) -> list[Typed]:
    """Return the commands of a session: after `$ `, going on after `> `, then their output."""
    found: list[Typed] = []
    for part in re.split(r"^\$ ", console, flags=re.MULTILINE)[1:]:
        first, *rest = part.splitlines()
        more = [line[2:] for line in rest if line.startswith("> ")]
        output = tuple(line for line in rest if line.strip() and not line.startswith("> "))
        found.append(Typed(command="\n".join([first, *more]), shown=output))
    return found


def type_in(session: list[Typed], folder: Path, programs: Path) -> Ended:
    """Run a session; every command but the last must end with 0. Return how the last ended."""
    _put_compiler(programs)
    ended: list[Ended] = []
    for step in session:
        assert all(done.code == 0 for done in ended), ended
        with contextlib.chdir(folder):
            done = _typed_into_sh(step.command, programs)
        missing = [line for line in step.shown if line not in done.said]
        assert not missing, f"{step.command}: {done.said}"
        ended.append(done)
    return ended[-1]


def _typed_into_sh(command: str, programs: Path) -> Ended:
    environment = {name: text for name, text in os.environ.items() if not _is_ours(name)}
    environment["PATH"] = os.pathsep.join([str(programs), environment.get("PATH", "")])
    done = subprocess.run(
        ["sh", "-c", command],
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        timeout=120,
    )
    return Ended(code=done.returncode, said=done.stdout)


def _put_compiler(programs: Path) -> None:
    """Let `plutoc` be this checkout, under the Python that runs the tests."""
    programs.mkdir()
    program = programs / "plutoc.py"
    program.write_text(
        f"import sys\nsys.path[:0] = {_PATHS!r}\n"
        "from plutoc.cli import main\nraise SystemExit(main())\n",
        encoding="utf-8",
    )
    script = programs / "plutoc"
    script.write_text(f"#!/bin/sh\nexec '{sys.executable}' '{program}' \"$@\"\n", encoding="utf-8")
    script.chmod(0o755)


def _is_ours(name: str) -> bool:
    return name.startswith(("PYTHON", "PLUTO")) or name in ("NO_COLOR", "FORCE_COLOR")
