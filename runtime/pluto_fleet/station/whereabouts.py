"""At which blocks of its graph a mission is now."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

from plutoc_runtime.blame import waiting_at
from plutoc_runtime.status import Status

if TYPE_CHECKING:
    from plutoc_runtime.state import State

END = "end"
"""Where missions are that have ended."""

ENDED = (Status.COMPLETED, Status.FAILED, Status.CANCELLED)

_BRANCHES = re.compile(r"\[(.*)\]")
_WORD = re.compile(r"\w+")


def blocks_of(state: State, flow: Callable[..., Any]) -> tuple[str, ...]:
    """Return the blocks at which a living mission waits: several within a fork.

    They are read off its coroutine, which waits below a comment that quotes the block's declaration:
    so a flight costs nothing more for being watched.
    """
    if state.task is None:
        return (state.at,) if state.at is not None else ()
    return _named(waiting_at(state.task.coroutine, flow))


@cache
def _named(declaration: str) -> tuple[str, ...]:
    """Read `launch -> [watch, timer] -> first = GateFIFO` as two blocks, `wait = Clock` as one."""
    branches = _BRANCHES.search(declaration.partition("(")[0])
    if branches is not None:
        return tuple(word[0] for part in branches[1].split(",") if (word := _WORD.search(part)))
    word = _WORD.match(declaration)
    return (word[0],) if word is not None else ()
