"""Async tests are written as such: each is run on a loop of its own."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Coroutine
from typing import Any

import pytest


def run_async(
    test: pytest.Function, run: Callable[[Coroutine[Any, Any, object]], object]
) -> bool | None:
    """Run a test if it is async; `None`: it is not, and pytest calls it."""
    if not inspect.iscoroutinefunction(test.obj):
        return None
    wanted = inspect.signature(test.obj).parameters
    run(test.obj(**{name: test.funcargs[name] for name in wanted}))
    return True
