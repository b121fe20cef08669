"""Cases in text files: under a title what is given, and behind a line that begins with `-- ` what must come of it.

    == A bound of no attempts is none
    retry = PriorityManager(max_attempts: 0)
    -- refused
    error P2001 ...

Lines that begin with `# ` are remarks. `pytest FOLDER --update` writes what comes as what must come: read the difference before committing.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

_TITLE = re.compile(r"^== (.+)\n", re.MULTILINE)
_COMES = re.compile(r"^-- ", re.MULTILINE)


@dataclass(frozen=True, kw_only=True)
class Section:
    """One case of a file."""

    path: Path
    title: str
    begun: str
    """All before what comes, remarks too."""
    given: str
    comes: str
    """From the first line that begins with `-- `; empty where that is still to be written."""


def sections(*paths: Path) -> list[Section]:
    """Return the cases of some files, in their order; each title stands once in a file."""
    found = []
    for path in paths:
        _, *parts = _TITLE.split(path.read_text(encoding="utf-8"))
        assert len(set(parts[::2])) == len(parts[::2]) > 0, path
        for title, text in zip(parts[::2], parts[1::2], strict=True):
            begins = _COMES.search(text)
            cut = begins.start() if begins else len(text)
            begun, comes = text[:cut].strip(), text[cut:].strip()
            given = "\n".join(line for line in begun.splitlines() if not line.startswith("# "))
            found.append(Section(path=path, title=title, begun=begun, given=given, comes=comes))
    return found


def params(*paths: Path) -> list[Any]:
    """Return the cases to parametrize a test with."""
    return [
        pytest.param(section, id=f"{section.path.stem}: {section.title}")
        for section in sections(*paths)
    ]


def given(*paths: Path) -> dict[str, str]:
    """Return what is given in each case, by its title."""
    return {section.title: section.given for section in sections(*paths)}


def compare(section: Section, comes: str, update: bool) -> None:
    """Hold what comes against what must come, or write it as that."""
    comes = comes.strip()
    if not update:
        assert comes == section.comes
        return
    text = section.path.read_text(encoding="utf-8")
    before, head, rest = text.partition(f"== {section.title}\n")
    following = _TITLE.search(rest)
    behind = rest[following.start() :] if following else ""
    made = f"{before}{head}{section.begun}\n{comes}\n\n{behind}"
    section.path.write_text(made.rstrip() + "\n", encoding="utf-8")
