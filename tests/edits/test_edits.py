"""A small edit of the source is a small difference of the package: people review it."""

from __future__ import annotations

import pytest

from plutoc.compile import analyse
from plutoc.source import Source
from tests.edits.changes import changes_of
from tests.edits.edits import ALFALFA, EDITS, Edit, renamed

MOST = 70
"""Lines of nine edits together, added and removed; the lock and copied modules' text aside."""

BLOCKS = [node.name for node in analyse(Source("app.pluto", ALFALFA))[0].graph.nodes]


def test_nine_edits_change_few_lines() -> None:
    """Those of hooks.py count too, and a module that joins or leaves is a line."""
    found = {edit.name: changes_of(edit) for edit in EDITS}
    counts = {name: changes.count for name, changes in found.items()}
    told = "\n".join(f"{name}: {counts[name]}\n{changes}" for name, changes in found.items())
    assert sum(counts.values()) <= MOST, told
    assert counts["add a comment at the top"] == 0


def test_comments_and_blank_lines_change_nothing() -> None:
    """Before every statement, and behind it."""
    lines = [f"{line}  # why\n\n# a field\n" for line in ALFALFA.splitlines()[1:]]
    assert not changes_of(Edit(name="comments", after="".join(["pluto 1\n", *lines]))).count


@pytest.mark.parametrize("block", BLOCKS)
def test_another_name_for_a_block_changes_the_lines_that_say_it(block: str) -> None:
    """Two of the README and those that quote the declaration or jump there."""
    changes = changes_of(Edit(name="rename", after=renamed(block, f"x{block[1:]}")))
    assert changes.count <= 10, str(changes)
    assert not changes.modules
