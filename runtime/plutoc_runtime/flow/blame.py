"""In which block a mission waits, or an error arose: `flow.py` quotes a block's declaration above each call of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..domain.text import said

if TYPE_CHECKING:
    from types import CodeType, FrameType


def blame(error: BaseException, flow: Callable[..., Any]) -> None:
    """Add to an error that escapes from a flow in which block it arose: `in block watch = TripMonitor`."""
    block = blamed(error, flow)
    if block:
        error.add_note(f"in block {block}")


def as_crash(error: BaseException) -> Exception:
    """Return an error that ends the app as a bug: a block's `SystemExit` would pass for a normal end."""
    if isinstance(error, Exception):
        return error
    return RuntimeError(f"it raised {said(error)}").with_traceback(error.__traceback__)


def traced(error: BaseException) -> str:
    """Return where an error arose, and what it says, for the log."""
    from traceback import format_tb  # only where something has gone wrong

    return "".join(format_tb(error.__traceback__)) + said(error)


def blamed(error: BaseException, flow: Callable[..., Any]) -> str:
    """Return the declaration of the block in which an error arose; empty if it was in none.

    Of a fork and its gate it is what stands in their place: `launch -> [a, b] -> first = GateFIFO`.
    """
    from traceback import walk_tb  # only where something has gone wrong

    code, found = getattr(flow, "__code__", None), ""
    for frame, line in walk_tb(error.__traceback__):
        if code is not None and frame.f_code.co_filename == code.co_filename:
            found = declaration_above(frame, line) or found
    return found


def declaration_above(frame: FrameType, line: int) -> str:
    """Return the nearest comment above a line of a function that is not within an arm before it."""
    import linecache

    margin = None
    for number in range(line, frame.f_code.co_firstlineno, -1):
        text = linecache.getline(frame.f_code.co_filename, number, frame.f_globals)
        indent = len(text) - len(text.lstrip())
        if not text.strip() or (margin is not None and indent > margin):
            continue
        margin = indent
        if text.lstrip().startswith("# "):
            return text.strip().removeprefix("# ")
    return ""


_KNOWN: dict[tuple[CodeType, int], str] = {}  # a cache of comments, by the line below them


def waiting_at(coroutine: object, flow: Callable[..., Any]) -> str:
    """Return the declaration of the block at which a mission's coroutine waits, or nothing.

    It is found by the suspended frames, so that observing a flight costs it nothing.
    """
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
