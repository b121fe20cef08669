"""Nine edits of the alfalfa example, as one makes them between two commits."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from tests.paths import ROOT

EXAMPLE = ROOT / "examples/alfalfa"
ALFALFA = (EXAMPLE / "app.pluto").read_text(encoding="utf-8")
HOOKS = (EXAMPLE / "hooks.py").read_text(encoding="utf-8")
SHORTER = (ROOT / "tests/cases/alfalfa/app.pluto").read_text(encoding="utf-8")
"""The same app with its clock outside of every loop: another arrow to it makes a second one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """A source before and after."""

    name: str
    before: str
    after: str


def edited(text: str, *replacements: tuple[str, str]) -> str:
    """Return a text with something else in place of what it holds exactly once."""
    for old, new in replacements:
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in the source"
        text = text.replace(old, new)
    return text


def renamed(text: str, old: str, new: str) -> str:
    """Return a text with another name for a block; what comments say stays."""
    return "\n".join(
        re.sub(rf"\b{old}\b", new, code) + comment for code, comment in _halves(text.split("\n"))
    )


def _halves(lines: Iterable[str]) -> Iterable[tuple[str, str]]:
    for line in lines:
        code, sign, comment = line.partition("#")
        yield code, sign + comment


def nine(text: str) -> Iterator[Edit]:
    """Yield nine edits of an app like alfalfa."""

    def edit(name: str, *replacements: tuple[str, str]) -> Edit:
        return Edit(name=name, before=text, after=edited(text, *replacements))

    gate = "  first = GateFIFO\n"
    yield Edit(name="rename a block", before=text, after=renamed(text, "judge", "assess"))
    yield edit(
        "add a third branch to a fork",
        (gate, f"  gap = GapMonitor(default: 2 min)\n{gate}"),
        ("[watch, timer]", "[watch, timer, gap]"),
    )
    yield edit("change a parameter", ("max_attempts: 3", "max_attempts: 5"))
    inserted = edit(
        "insert a block in a chain",
        (gate, f"{gate}  rest = Clock\n"),
        ("  retry -> allocate when STANDBY\n", "  retry -> rest -> allocate\n"),
    )
    yield inserted
    yield Edit(name="remove it", before=inserted.after, after=text)
    yield edit("retarget an edge", ("  retry -> allocate when", "  retry -> wait when"))
    evaluator = "  evaluator find_blooms\n"
    yield edit("add a hook", (evaluator, f"{evaluator}  evaluator find_pests\n"))
    judged = "  judge -> allocate when STANDBY"
    yield edit("change a guard", (judged, f"{judged}, FAILED"))
    yield edit("add a comment at the top", ("pluto 1\n", "pluto 1\n# The field behind the barn.\n"))
