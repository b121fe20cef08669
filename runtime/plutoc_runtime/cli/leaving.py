"""The app has come to its end: what its hooks have started must not keep it from leaving."""

from __future__ import annotations

import os
import sys
import threading
import time
from typing import TYPE_CHECKING

from . import output

if TYPE_CHECKING:
    from multiprocessing.process import BaseProcess

GRACE = 5.0
"""Seconds that hooks' threads and processes get to end by themselves."""

_LAST = 1.0
"""Seconds between asking a process to end and ending it."""


def leave_in_time(name: str, code: int) -> None:
    """See to it that this process ends soon after its main thread has, with this exit code.

    Python waits for threads, and for what `multiprocessing` has started, however long they live.
    """
    if _threads() or _children():
        threading.Thread(target=_watch, args=(name, code), daemon=True).start()


def _watch(name: str, code: int) -> None:
    threading.main_thread().join()
    until = time.monotonic() + GRACE
    while time.monotonic() < until:
        time.sleep(_LAST / 10)  # a daemon thread: it ends with the process
    children = _children()
    pids = ", ".join(str(child.pid) for child in children)
    what = f"a process that a hook has started (number {pids})" if pids else "a thread of a hook"
    output.tell(f"{name}: {what} does not end, and is ended with the app")
    for child in children:
        child.terminate()
    until = time.monotonic() + _LAST
    for child in children:
        child.join(max(0.0, until - time.monotonic()))
        child.kill()
    os._exit(code)


def _threads() -> list[threading.Thread]:
    main = threading.main_thread()
    return [one for one in threading.enumerate() if one is not main and not one.daemon]


def _children() -> list[BaseProcess]:
    """Return what `multiprocessing` has started, if anything of the app's uses it."""
    if "multiprocessing" not in sys.modules:
        return []
    from multiprocessing import active_children

    return active_children()
