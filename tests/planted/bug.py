"""A bug: a piece of a source file, and what stands there instead."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.paths import ROOT

HERE = Path(__file__).parent
ROOMS = {
    "brain": ("runtime/plutoc_runtime", "stdlib_blocks/plutoc_blocks"),
    "check": ("plutoc/check",),
    "plan": ("plutoc/plan",),
    "gateway": ("runtime/pluto_fleet/gateway",),
}
"""Where bugs are drawn."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bug:
    """One change of one file."""

    file: str
    """Relative to the checkout."""
    start: int
    """Where the text begins that is replaced, in characters."""
    before: str
    after: str
    what: str
    """The kind of mistake, or, for one that was planted by hand, a sentence."""

    def line(self, text: str) -> int:
        """Return the first line that changes, counted from 1."""
        return text.count("\n", 0, self.start) + 1

    def planted(self, text: str) -> str:
        """Return the file with this bug."""
        end = self.start + len(self.before)
        assert text[self.start : end] == self.before
        return text[: self.start] + self.after + text[end:]

    def key(self, text: str) -> tuple[str, str, str, str]:
        """Return what it is, by the line on which it begins, wherever in its file that stands."""
        line = text.splitlines()[self.line(text) - 1].strip()
        return self.file, line, self.before, self.after


def named_bugs() -> list[Bug]:
    """Return the bugs that were planted by hand; raise `ValueError` where one has no place any more."""
    found = []
    for entry in _entries("named.toml"):
        text = (ROOT / entry["file"]).read_text(encoding="utf-8")
        times = text.count(entry["before"])
        if times != 1:
            raise ValueError(
                f"named.toml: {entry['file']} has {entry['before']!r} {times} times and not once"
            )
        found.append(Bug(start=text.index(entry["before"]), **entry))
    return found


@dataclass(frozen=True, slots=True, kw_only=True)
class Left:
    """Why a bug that nothing catches is left."""

    why: str
    equivalent: bool
    """Nobody could see it: what the change does is the same, so it is no bug."""


def left() -> Mapping[tuple[str, str, str, str], Left]:
    """Return why each bug that nothing catches is left; raise `ValueError` where one has no place any more."""
    for one in _entries("left.toml"):
        lines = (ROOT / one["file"]).read_text(encoding="utf-8").splitlines()
        if one["line"] not in map(str.strip, lines):
            raise ValueError(f"left.toml: {one['file']} has no line {one['line']!r}")
    return {
        (one["file"], one["line"], one["before"], one["after"]): Left(
            why=one["why"], equivalent=bool(one.get("equivalent"))
        )
        for one in _entries("left.toml")
    }


def _entries(name: str) -> list[Mapping[str, Any]]:
    text = (HERE / name).read_text(encoding="utf-8")
    entries: list[Mapping[str, Any]] = tomllib.loads(text).get("bug", [])
    return entries
