"""At which blocks of its graph a mission is now."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from types import CodeType, FrameType
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import Status
from plutoc_runtime.flow.location import declaration_above

if TYPE_CHECKING:
    from plutoc_runtime.flow.mission import MissionState

END = "end"
"""Where missions are that have ended."""

ENDED = (Status.COMPLETED, Status.FAILED, Status.CANCELLED)

_BRANCHES = re.compile(r"\[(.*)\]")
_WORD = re.compile(r"\w+")


def blocks_of(state: MissionState, flow: Callable[..., Any]) -> tuple[str, ...]:
    """Return the blocks at which a living mission waits: several within a fork.

    They are read off its coroutine, which waits below a comment that quotes the block's declaration:
    so a flight costs nothing more for being watched.
    """
    if state.task is None:
        return (state.at,) if state.at is not None else ()
    return _named(_waiting_at(state.task.coroutine, flow))


_KNOWN: dict[tuple[CodeType, int], str] = {}
"""Comments that were found before, by the line below them."""


def _waiting_at(coroutine: object, flow: Callable[..., Any]) -> str:
    """Return the declaration of the block at which a mission's coroutine waits; empty: at none."""
    file, found = flow.__code__.co_filename, ""
    while coroutine is not None:
        frame: FrameType | None = getattr(coroutine, "cr_frame", None)
        if frame is not None and frame.f_code.co_filename == file:
            place = frame.f_code, frame.f_lineno
            if place not in _KNOWN:
                _KNOWN[place] = declaration_above(frame, frame.f_lineno)
            found = _KNOWN[place] or found
        coroutine = getattr(coroutine, "cr_await", None)
    return found


@cache
def _named(declaration: str) -> tuple[str, ...]:
    """Read `launch -> [watch, timer] -> first = GateFIFO` as two blocks, `wait = Clock` as one."""
    branches = _BRANCHES.search(declaration.partition("(")[0])
    if branches is not None:
        return tuple(word[0] for part in branches[1].split(",") if (word := _WORD.search(part)))
    word = _WORD.match(declaration)
    return (word[0],) if word is not None else ()
