"""In which block a mission is: `flow.py` quotes a block's declaration above each call of it.

So it can be told of an error that arose, and of a coroutine that waits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import CodeType, FrameType, TracebackType
from typing import Any

from .hooks import said

_KNOWN: dict[tuple[CodeType, int], str] = {}
"""Comments that were found before, by the line below them."""


def blame(error: BaseException, flow: Callable[..., Any]) -> None:
    """Add to an error that escapes from a flow in which block it arose.

    A traceback then ends like this:

        ZeroDivisionError: division by zero
        in block launch = TripLauncher
    """
    block = blamed(error, flow)
    if block:
        error.add_note(f"in block {block}")


def as_crash(error: BaseException) -> Exception:
    """Return an error that ends the app as a mistake: a block's `SystemExit` would pass for an end."""
    if isinstance(error, Exception):
        return error
    return RuntimeError(f"it raised {said(error)}").with_traceback(error.__traceback__)


def blamed(error: BaseException, flow: Callable[..., Any]) -> str:
    """Return the declaration of the block in which an error arose; empty if it was in none.

    Of a fork and its gate it is what stands in their place: `launch -> [a, b] -> first = GateFIFO`.
    """
    file = getattr(flow, "__code__", None)
    found = ""
    for frame, line in _frames(error.__traceback__):
        if file is not None and frame.f_code.co_filename == file.co_filename:
            found = _above(frame, line) or found
    return found


def waiting_at(coroutine: object, flow: Callable[..., Any]) -> str:
    """Return the declaration of the block at which a mission's coroutine waits; empty: at none."""
    file, found = flow.__code__.co_filename, ""
    while coroutine is not None:
        frame: FrameType | None = getattr(coroutine, "cr_frame", None)
        if frame is not None and frame.f_code.co_filename == file:
            place = frame.f_code, frame.f_lineno
            if place not in _KNOWN:
                _KNOWN[place] = _above(frame, frame.f_lineno)
            found = _KNOWN[place] or found
        coroutine = getattr(coroutine, "cr_await", None)
    return found


def _frames(trace: TracebackType | None) -> Iterator[tuple[FrameType, int]]:
    """Yield where an error came through, the place where it arose last."""
    while trace is not None:
        yield trace.tb_frame, trace.tb_lineno
        trace = trace.tb_next


def _above(frame: FrameType, line: int) -> str:
    """Return the nearest comment above a line of a function that is not within an arm before it."""
    import linecache  # only where something has gone wrong

    margin = None
    for number in range(line, frame.f_code.co_firstlineno, -1):
        text = linecache.getline(frame.f_code.co_filename, number, frame.f_globals)
        if not text.strip():
            continue
        indent = len(text) - len(text.lstrip())
        if margin is not None and indent > margin:
            continue
        margin = indent
        if text.lstrip().startswith("# "):
            return text.strip().removeprefix("# ")
    return ""
