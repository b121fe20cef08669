"""What a hook calls and should await: else it is not done, and Python only warns of it."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from contextvars import ContextVar
from types import CoroutineType
from typing import Any, TypeVar

from .guard import guarded

T = TypeVar("T")

_WARN = "_warn_unawaited_coroutine"
"""What Python calls, of `warnings`, with a coroutine that has gone without an `await`."""
_warn: Callable[[object], object] = vars(warnings).get(_WARN, id)
_lost: ContextVar[list[str] | None] = ContextVar("lost", default=None)


def all_awaited(step: Callable[[], T]) -> T:
    """Take a step of a hook, guarded; raise `RuntimeError` with the place of what it does not await."""
    lost: list[str] = []
    before, depth = _lost.set(lost), sys.get_coroutine_origin_tracking_depth()
    sys.set_coroutine_origin_tracking_depth(1)
    vars(warnings)[_WARN] = _note
    try:
        returned = guarded(step)
    except StopIteration as end:
        if type(end.value) is CoroutineType:
            _note(end.value)
            end.value.close()
        if not lost:
            raise
    finally:
        vars(warnings)[_WARN] = _warn
        sys.set_coroutine_origin_tracking_depth(depth)
        _lost.reset(before)
    if lost:
        raise RuntimeError(lost[0])
    return returned


def _note(made: CoroutineType[Any, Any, Any]) -> None:
    lost, origin = _lost.get(), made.cr_origin
    if lost is None or not origin:  # of another thread
        _warn(made)
    else:
        lost.append(f"it does not await {made.__qualname__}: {origin[0][0]}:{origin[0][1]}")
