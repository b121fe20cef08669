"""Which hooks run straight through: they need no task."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from inspect import CO_COROUTINE
from opcode import opmap
from types import CodeType


def never_waits(hook: Callable[..., object]) -> bool:
    """Say whether this is an `async def` without any `await`, `async for` or `async with`."""
    code = getattr(getattr(hook, "func", hook), "__code__", None)  # a partial carries its function
    return isinstance(code, CodeType) and _runs_through(code)


@lru_cache(maxsize=1_000)
def _runs_through(code: CodeType) -> bool:
    waits = opmap.get("SEND")  # what every way to wait is compiled to
    return bool(waits and code.co_flags & CO_COROUTINE and waits not in code.co_code[::2])
