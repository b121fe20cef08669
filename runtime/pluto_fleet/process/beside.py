"""One task in a forked copy of this process, beside a running event loop.

The copy has a low priority, so that nothing waits for it here, and sends what it finds piece by
piece. Cancelling the reader ends it at once, in the middle of its task.
"""

from __future__ import annotations

import gc
import os
import signal
from collections.abc import AsyncGenerator, Callable, Iterable
from contextlib import redirect_stderr, redirect_stdout
from functools import partial
from io import StringIO
from multiprocessing.connection import Connection, Pipe
from threading import Thread
from typing import NamedTuple, TypeVar, cast

from .at_once import at_once
from .copies import Died, Raised, forked, hear_signals, outcome, reaped
from .forked import not_for_children

R = TypeVar("R")

NICE = 10
"""The priority of a copy, as `nice` counts."""


class _Found(NamedTuple):
    found: object


async def in_a_copy(work: Callable[[], Iterable[R]]) -> AsyncGenerator[R, None]:
    """Do a task in a forked copy of this process, and yield what it yields.

    An error in it is raised here; `Died` tells that it has ended without, or as by a person. What it
    prints is dropped.
    """
    pipe, sends = Pipe(duplex=False)
    process = forked(partial(_work, work, pipe, sends))
    sends.close()
    try:
        while isinstance(message := await at_once(pipe.recv), _Found):
            yield cast(R, message.found)
    except (EOFError, OSError):
        end = process
        process = 0
        os.kill(end, signal.SIGKILL)  # it may have closed its pipe and gone on
        raise Died(await at_once(partial(reaped, end))) from None
    finally:
        if process:
            os.kill(process, signal.SIGKILL)
            Thread(target=reaped, args=(process,), daemon=True).start()  # that takes a while
    if isinstance(message, Raised):
        error = message.error
        error.add_note(message.trace)
        if not isinstance(
            error, Exception
        ):  # it would end this process, or pass for a cancellation
            raise Died(f"ended by {type(error).__name__}")
        raise error


def _work(work: Callable[[], Iterable[object]], pipe: Connection, sends: Connection) -> None:
    """Do the task, send what it finds, and then what it raised, or None."""
    pipe.close()
    not_for_children(sends.fileno())  # else the reader would wait for a hook's children, too
    signal.set_wakeup_fd(-1)
    hear_signals(signal.SIG_DFL)
    os.nice(NICE)
    gc.freeze()  # what is open here must not be closed there: a journal, a connection

    def find() -> None:
        for found in work():
            sends.send(_Found(found))

    with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
        sends.send(outcome(find))
