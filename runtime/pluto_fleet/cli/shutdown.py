"""What hooks have started and left behind neither ends the app nor keeps it from leaving."""

from __future__ import annotations

import asyncio
import atexit
import sys
import threading
import time
from collections.abc import Coroutine
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from plutoc_runtime import output
from plutoc_runtime.domain.errors import ANY_ERROR
from plutoc_runtime.hooks.calls import said

from ..process.forked import leave
from ..process.signal_guard import by_a_person

if TYPE_CHECKING:
    from multiprocessing.process import BaseProcess

T = TypeVar("T")

HOOKS_END_WITHIN = 5.0
"""Seconds that hooks' threads and processes get to end by themselves."""

_KILLED_AFTER = 1.0
"""Seconds between asking a process to end and ending it."""


_stubborn: list[asyncio.Task[Any]] = []
"""The tasks that do not end when they are cancelled: Python would wait for them when it forgets them."""


def run(main: Coroutine[Any, Any, T]) -> T:
    """Do as `asyncio.run` does, which a hook's own tasks could end, or keep waiting for ever."""
    loop = asyncio.new_event_loop()
    asyncio.set_event_loop(loop)
    try:
        return _through(loop, main)
    finally:
        left = asyncio.all_tasks(loop)
        for task in left:
            task.cancel()
        left.add(loop.create_task(loop.shutdown_asyncgens()))
        _, pending = _through(loop, asyncio.wait(left, timeout=HOOKS_END_WITHIN))
        _stubborn.extend(pending)
        asyncio.set_event_loop(None)
        loop.close()


def _through(loop: asyncio.AbstractEventLoop, main: Coroutine[Any, Any, T]) -> T:
    """See this through: `SystemExit`, say, in a task that a hook has made, stops the loop."""
    task = loop.create_task(main)
    while not task.done():
        try:
            loop.run_until_complete(task)
        except ANY_ERROR as error:
            if task.done() or by_a_person(error):
                raise
            output.tell(f"a task that a hook has made ends: {said(error)}")
    return task.result()


def leave_in_time(name: str, code: int) -> None:
    """See to it that this process ends soon once Python begins to end it, with this exit code.

    Python waits for threads, for what `multiprocessing` has started, and for what is registered by
    `atexit`, however long that takes.
    """
    if _stubborn:
        _end(name, code)  # they had their time
    leaves = threading.Event()
    # by `atexit` it would hear of that only when all threads of executors have ended
    getattr(threading, "_register_atexit", atexit.register)(leaves.set)
    threading.Thread(target=_watch, args=(name, code, leaves), daemon=True).start()


def _watch(name: str, code: int, leaves: threading.Event) -> None:
    leaves.wait()
    time.sleep(HOOKS_END_WITHIN)  # in a daemon thread: it ends with the process
    _end(name, code)


def _end(name: str, code: int) -> NoReturn:
    children = _children()
    pids = ", ".join(str(child.pid) for child in children)
    what = (
        f"a process that a hook has started (number {pids})"
        if pids
        else "a thread or a task of a hook"
    )
    output.tell(f"{name}: {what} does not end, and is ended with the app")
    for child in children:
        child.terminate()
    until = time.monotonic() + _KILLED_AFTER
    for child in children:
        child.join(max(0.0, until - time.monotonic()))
        child.kill()
    leave(code)


def _children() -> list[BaseProcess]:
    """Return what `multiprocessing` has started, if anything of the app's uses it."""
    if "multiprocessing" not in sys.modules:
        return []
    from multiprocessing import active_children

    return active_children()
