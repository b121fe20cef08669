"""Nine edits of the alfalfa example, as one makes them between two commits."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

EXAMPLE = Path(__file__).parents[2] / "examples/alfalfa"
ALFALFA = (EXAMPLE / "app.pluto").read_text(encoding="utf-8")
HOOKS = (EXAMPLE / "hooks.py").read_text(encoding="utf-8")


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """A source before and after."""

    name: str
    after: str
    before: str = ALFALFA


def edited(*replacements: tuple[str, str], text: str = ALFALFA) -> str:
    """Return a text with something else in place of what it holds exactly once."""
    for old, new in replacements:
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in the source"
        text = text.replace(old, new)
    return text


def renamed(old: str, new: str, text: str = ALFALFA) -> str:
    """Return a text with another name for a block; what comments say stays."""
    return "\n".join(
        re.sub(rf"\b{old}\b", new, code) + comment for code, comment in _halves(text.split("\n"))
    )


def _halves(lines: Iterable[str]) -> Iterable[tuple[str, str]]:
    for line in lines:
        code, sign, comment = line.partition("#")
        yield code, sign + comment


RESTED = edited(
    ("  first = GateFIFO\n", "  first = GateFIFO\n  rest = Clock\n"),
    ("  retry -> allocate when STANDBY\n", "  retry -> rest -> allocate\n"),
)

EDITS = (
    Edit(name="rename a block", after=renamed("judge", "assess")),
    Edit(
        name="add a third branch to a fork",
        after=edited(
            ("  first = GateFIFO\n", "  gap = GapMonitor(default: 2 min)\n  first = GateFIFO\n"),
            ("[watch, timer]", "[watch, timer, gap]"),
        ),
    ),
    Edit(name="change a parameter", after=edited(("max_attempts: 3", "max_attempts: 5"))),
    Edit(name="insert a block in a chain", after=RESTED),
    Edit(name="remove it", before=RESTED, after=ALFALFA),
    Edit(
        name="retarget an edge",
        after=edited(("  retry -> allocate when", "  retry -> wait when")),
    ),
    Edit(
        name="add a hook",
        after=edited(
            ("  evaluator find_blooms\n", "  evaluator find_blooms\n  evaluator find_pests\n")
        ),
    ),
    Edit(
        name="change a guard",
        after=edited(
            ("  judge -> allocate when STANDBY", "  judge -> allocate when STANDBY, FAILED")
        ),
    ),
    Edit(
        name="add a comment at the top",
        after=edited(("pluto 1\n", "pluto 1\n# The field behind the barn.\n")),
    ),
)
