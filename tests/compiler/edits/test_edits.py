"""A small edit of the source is a small difference of the package: people review it."""

from __future__ import annotations

import pytest

from tests.compiler.edits.changes import changes_of
from tests.compiler.edits.edits import ALFALFA, SHORTER, nine

MOST = 70
"""Lines of nine edits together, added and removed; the lock and copied modules' text aside."""


@pytest.mark.parametrize("text", [ALFALFA, SHORTER], ids=["example", "shorter"])
def test_nine_edits_change_few_lines(text: str) -> None:
    """Those of hooks.py count too, and a module that joins or leaves is a line."""
    found = {edit.name: changes_of(edit) for edit in nine(text)}
    assert len(found) == 9
    counts = {name: changes.count for name, changes in found.items()}
    told = "\n".join(f"{name}: {counts[name]}\n{changes}" for name, changes in found.items())
    assert sum(counts.values()) <= MOST, told
    assert counts["add a comment at the top"] == 0
