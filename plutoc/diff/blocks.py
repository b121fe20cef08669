"""Blocks that are new, gone, or called otherwise."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from plutoc.diff.both import Both
from plutoc.diff.model import Change
from plutoc.diff.words import blocks as words


def blocks(both: Both, told: Sequence[Change]) -> Iterator[Change]:
    """Tell of the blocks themselves; `told` is what was found about anything else."""
    about = {name for change in told for name in change.blocks}
    for old, new in both.common():
        if old.name != new.name:
            yield words.block_renamed(old, new, alone=new.name not in about)
    for node in both.gone():
        yield words.block_removed(node)
    for node in both.added():
        yield words.block_added(node)
