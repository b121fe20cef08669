"""The examples of a page, and what the compiler says of them."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

from plutoc.cli import main
from plutoc.explain.pages import page
from tests.examples.typed import Reader

CODE = re.compile(r"\bP\d{4}\b")
WITHOUT_EXAMPLES = ("P2026", "P9001")
"""An app with so many states has more blocks than a page has lines; and no one can write one that
makes the compiler break: else it would be mended."""

_FENCED = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_SECTION = re.compile(r"^## (.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)
_FILES = {"pluto": "app.pluto", "python": "hooks.py"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Example:
    """The files of an example by their names, and what is to be typed, if that shows more."""

    files: dict[str, str]
    console: str | None


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


def type_in(console: str, folder: Path, programs: Path) -> tuple[int, str]:
    """Type what stands after `$ `, and goes on after `> `; return how the last command ended, and all that came."""
    lines = [line for line in console.splitlines() if line.strip()]
    typed = [line[2:] for line in lines if line.startswith(("$ ", "> "))]
    done = subprocess.run(
        ["sh", "-e", "-c", "\n".join(typed)],
        cwd=folder,
        env=Reader(folder, programs).environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    shown = [line for line in lines if not line.startswith(("$ ", "> "))]
    assert [line for line in shown if line not in done.stdout] == [], done.stdout
    return done.returncode, done.stdout
