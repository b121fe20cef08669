"""One task in a forked copy of this process, beside a running event loop.

The copy has a low priority, so that nothing waits for it here, and sends what it finds piece by
piece. Cancelling the reader ends it at once, in the middle of its task.
"""

from __future__ import annotations

import asyncio
import gc
import os
import signal
import threading
import traceback
import warnings
from collections.abc import AsyncGenerator, Callable, Iterable
from contextlib import redirect_stderr, redirect_stdout, suppress
from io import StringIO
from multiprocessing.connection import Connection, Pipe
from typing import NamedTuple, TypeVar

from ..shared import output
from ..shared.domain.errors import ANY_ERROR
from .forked import leave, not_for_children, refused
from .workers import Raised, how_it_ended, portable

R = TypeVar("R")

NICE = 10
"""The priority of a copy, as `nice` counts."""


class Died(Exception):
    """A copy has ended before its task: it was killed, or a hook has crashed the interpreter."""


class _Found(NamedTuple):
    found: object


class _End(NamedTuple):
    error: BaseException | None


async def in_a_copy(work: Callable[[], Iterable[R]]) -> AsyncGenerator[R, None]:
    """Do a task in a forked copy of this process, and yield what it yields.

    An error in it is raised here; `Died` tells that it has ended without, or as by a person. What it
    prints is dropped.
    """
    loop, found = asyncio.get_running_loop(), asyncio.Queue[_Found | _End]()
    copy = _Copy(work)

    def read() -> None:
        for message in copy.messages():
            with suppress(RuntimeError):  # the loop has been closed
                loop.call_soon_threadsafe(found.put_nowait, message)

    reading = threading.Thread(target=read, name="reads what a copy finds", daemon=True)
    reading.start()
    try:
        while isinstance(message := await found.get(), _Found):
            yield message.found  # type: ignore[misc]  # what the work has yielded
        if isinstance(message.error, Exception):
            raise message.error
        if message.error is not None:  # it would end this process, or pass for a cancellation
            raise Died(f"ended by {type(message.error).__name__}")
    finally:
        copy.end()


class _Copy:
    """A forked copy of this process, which does one task and leaves."""

    def __init__(self, work: Callable[[], Iterable[object]]) -> None:
        self._pipe, sends = Pipe(duplex=False)
        self._ended, self._reaped = False, threading.Lock()
        output.flush()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # threads of the event loop
            self._process = os.fork()
        if self._process == 0:
            self._pipe.close()
            _work(work, sends)
        sends.close()

    def messages(self) -> Iterable[_Found | _End]:
        """Yield what it sends, and its end, after which it is gone."""
        end: _End | None = None
        try:
            while end is None:
                message: _Found | _End | Raised = self._pipe.recv()
                if isinstance(message, Raised):
                    message.error.add_note(message.trace)
                    end = _End(message.error)
                elif isinstance(message, _End):
                    end = message
                else:
                    yield message
        except (EOFError, OSError):
            pass  # it has ended without
        except Exception as error:  # noqa: BLE001 - to read it may raise anything
            end = _End(error)
        self._pipe.close()
        with self._reaped:
            os.kill(self._process, signal.SIGKILL)  # it may have closed its pipe and gone on
            status = os.waitstatus_to_exitcode(os.waitpid(self._process, 0)[1])
            self._ended = True
        yield end or _End(Died(how_it_ended(status)))

    def end(self) -> None:
        """End it at once."""
        if self._reaped.acquire(blocking=False):  # else it has just ended
            try:
                if not self._ended:
                    os.kill(self._process, signal.SIGKILL)
            finally:
                self._reaped.release()


def _work(work: Callable[[], Iterable[object]], sends: Connection) -> None:
    """Do the task, and leave: in a copy nothing returns."""
    code = 1
    try:
        not_for_children(sends.fileno())  # else the reader would wait for a hook's children, too
        signal.set_wakeup_fd(-1)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL)
        os.nice(NICE)
        gc.freeze()  # what is open here must not be closed there: a journal, a connection
        with refused(), redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            sends.send(_outcome(work, sends))
        code = 0
    finally:
        leave(code)


def _outcome(work: Callable[[], Iterable[object]], sends: Connection) -> _End | Raised:
    try:
        for found in work():
            sends.send(_Found(found))
    except ANY_ERROR as error:
        return Raised(portable(error), "".join(traceback.format_exception(error)))
    return _End(None)
