"""Ending the process in time, whatever tasks, threads and processes hooks have left behind."""

from __future__ import annotations

import atexit
import sys
import threading
import time
from collections.abc import Coroutine
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from ..process.forked import leave
from ..process.signal_guard import by_a_person
from ..shared import output
from ..shared.domain.errors import ANY_ERROR
from ..shared.domain.text import said

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop, Task
    from multiprocessing.process import BaseProcess

T = TypeVar("T")

HOOKS_END_WITHIN = 5.0
"""Seconds that hooks' threads and processes have to end by themselves."""

_KILLED_AFTER = 1.0
"""Seconds between terminating a process and killing it."""


_stubborn: list[Task[Any]] = []
"""References to tasks that ignore their cancellation, so that they are not garbage-collected."""


def run(main: Coroutine[Any, Any, T]) -> T:
    """Like `asyncio.run`, but a hook's own tasks can neither end it nor block it for ever."""
    import asyncio  # a simulation does without

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


def _through(loop: AbstractEventLoop, main: Coroutine[Any, Any, T]) -> T:
    """Run to the end, even if an error such as `SystemExit` in a hook's own task stops the loop."""
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
    """Make this process exit soon, with this exit code, once Python begins to shut down.

    Python would wait without limit for threads, for processes of `multiprocessing`, and for functions
    registered with `atexit`.
    """
    if _stubborn:
        _end(name, code)  # their time is over
    leaves = threading.Event()
    # `atexit` would run only after all threads of executors have ended
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
    """Return the child processes of `multiprocessing`, if it is used."""
    if "multiprocessing" not in sys.modules:
        return []
    from multiprocessing import active_children

    return active_children()
