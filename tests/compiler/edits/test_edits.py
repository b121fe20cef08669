"""A small edit of the source is a small difference of the package: people review it."""

from __future__ import annotations

import pytest

from plutoc.compile import analyse
from plutoc.source import Source
from tests.compiler.edits.changes import changes_of
from tests.compiler.edits.edits import ALFALFA, SHORTER, Edit, nine, renamed

MOST = 70
"""Lines of nine edits together, added and removed; the lock and copied modules' text aside."""

BLOCKS = [node.name for node in analyse(Source("app.pluto", ALFALFA))[0].graph.nodes]


@pytest.mark.parametrize("text", [ALFALFA, SHORTER], ids=["example", "shorter"])
def test_nine_edits_change_few_lines(text: str) -> None:
    """Those of hooks.py count too, and a module that joins or leaves is a line."""
    found = {edit.name: changes_of(edit) for edit in nine(text)}
    assert len(found) == 9
    counts = {name: changes.count for name, changes in found.items()}
    told = "\n".join(f"{name}: {counts[name]}\n{changes}" for name, changes in found.items())
    assert sum(counts.values()) <= MOST, told
    assert counts["add a comment at the top"] == 0


def test_comments_and_blank_lines_change_nothing() -> None:
    """Before every statement, and behind it."""
    lines = [f"{line}  # why\n\n# a field\n" for line in ALFALFA.splitlines()[1:]]
    commented = Edit(name="comments", before=ALFALFA, after="".join(["pluto 1\n", *lines]))
    assert not changes_of(commented).count


@pytest.mark.parametrize("block", BLOCKS[::3])
def test_another_name_for_a_block_changes_the_lines_that_say_it(block: str) -> None:
    """Two of the README, those that quote the declaration or jump there, and where missions go on."""
    after = renamed(ALFALFA, block, f"x{block[1:]}")
    changes = changes_of(Edit(name="rename", before=ALFALFA, after=after))
    assert changes.count <= 14, str(changes)
    assert not changes.modules
