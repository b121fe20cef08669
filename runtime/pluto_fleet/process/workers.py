"""Work on all cores: forked copies of this process, which send back what they have found.

A copy has all that is loaded here, an app's hooks included, and takes nothing back but its results.
Which tasks share a copy does not depend on how many copies there are at once. So hooks that keep
something from task to task find the same with any number of jobs.
"""

from __future__ import annotations

import os
import pickle
import signal
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from functools import partial
from io import StringIO
from multiprocessing.connection import Connection, Pipe, wait
from types import FrameType
from typing import Any, NamedTuple, TypeVar

from ..shared import output
from .copies import BY_A_PERSON, Raised, forked, hear_signals, how_it_ended, outcome
from .forked import not_for_children

T = TypeVar("T")
R = TypeVar("R")

_ENOUGH, _MOST = 20, 50
"""Into how many parts tasks are divided, unless a part would have more than so many of them."""

_A_MOMENT = 0.5
"""Seconds: a signal that comes just before a wait is handled only after it."""


class WorkerDied(Exception):
    """A worker ended before its task: it was killed, or a hook has crashed the interpreter."""

    def __init__(self, place: int) -> None:
        super().__init__(place)
        self.place = place
        """Which task it had, from 0 on."""
        self.how = ""
        """How it ended, such as `was killed by SIGKILL`."""


class _InAWorker(Exception):
    """Shows where in a worker an error was raised."""


class _Done(NamedTuple):
    result: Any
    out: str
    err: str
    """What the task has printed."""


Message = _Done | Raised


class _Worker(NamedTuple):
    process: int
    places: deque[int]
    """The tasks that it has not done."""


def cores() -> int:
    """Return how many processes can work at once here."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def in_workers(
    work: Callable[[T], R], tasks: Sequence[T], jobs: int, *, quiet: bool = False
) -> Iterator[R]:
    """Do the tasks in as many processes at once as `jobs`; yield what comes of each, in order.

    What a task prints is printed in its turn, or not at all if `quiet`. An error in a worker is raised
    here; `WorkerDied` tells that one has ended without. Stopping early ends all workers.
    """
    size = max(1, min(_MOST, len(tasks) // _ENOUGH))
    parts = deque(
        range(start, min(start + size, len(tasks))) for start in range(0, len(tasks), size)
    )
    workers: dict[Connection, _Worker] = {}
    done: dict[int, Message] = {}
    with _ending(workers) as interrupts:
        for place in range(len(tasks)):
            while place not in done:
                while parts and len(workers) < jobs:
                    _begin(work, tasks, parts.popleft(), workers)
                for pipe in wait(list(workers), _A_MOMENT):
                    assert isinstance(pipe, Connection)
                    _take(pipe, workers, done)
                if interrupts:  # its handler raises nothing, or Python has dropped what it raised
                    raise KeyboardInterrupt
            this = done.pop(place)
            if isinstance(this, Raised):
                raise this.error from (_InAWorker(f"\n{this.trace}") if this.trace else None)
            if this.out and not quiet:
                output.line(this.out.removesuffix("\n"))
            if this.err and not quiet:
                output.tell(this.err.removesuffix("\n"))
            yield this.result


def _begin(
    work: Callable[[T], R],
    tasks: Sequence[T],
    places: Sequence[int],
    workers: dict[Connection, _Worker],
) -> None:
    receives, sends = Pipe(duplex=False)

    def begun() -> None:
        for pipe in (receives, *workers):
            pipe.close()  # else a worker would not notice that its reader has gone
        not_for_children(sends.fileno())  # else the reader would wait for a hook's children, too
        hear_signals(signal.SIG_DFL)
        _work(work, tasks, places, sends)

    with _held():  # until the worker is known: else nothing would end it
        workers[receives] = _Worker(forked(begun), deque(places))
    sends.close()


def _work(
    work: Callable[[T], R], tasks: Sequence[T], places: Sequence[int], sends: Connection
) -> None:
    """Do tasks, up to the first error."""

    def done(place: int) -> _Done:
        out = StringIO()
        err = StringIO()
        with redirect_stdout(out), redirect_stderr(err):
            result = work(tasks[place])
        return _Done(result, out.getvalue(), err.getvalue())

    for place in places:
        message = outcome(partial(done, place))
        sends.send(message)
        if isinstance(message, Raised):
            break


def _take(pipe: Connection, workers: dict[Connection, _Worker], done: dict[int, Message]) -> None:
    """Take a worker's next message, or its end."""
    worker = workers[pipe]
    place = worker.places.popleft()
    try:
        message: Message = pipe.recv()
        if worker.places and isinstance(message, _Done):
            done[place] = message
            return
    except (EOFError, OSError, pickle.UnpicklingError):
        message = Raised(WorkerDied(place), "")
    del workers[pipe]
    pipe.close()
    status = os.waitstatus_to_exitcode(os.waitpid(worker.process, 0)[1])
    if isinstance(message, Raised) and isinstance(message.error, WorkerDied):
        if status == -signal.SIGINT:
            raise KeyboardInterrupt  # the terminal has told the worker first
        message.error.how = how_it_ended(status)
    done[place] = message


@contextmanager
def _held() -> Iterator[None]:
    """Hold back the signals that ask this process to end; they are handled as this context ends.

    In a function that is called at a fork, Python drops what a handler raises.
    """
    noted: set[int] = set()
    handlers: dict[signal.Signals, Any] = {}
    with suppress(ValueError):  # not in the main thread
        for number in BY_A_PERSON:
            if callable(signal.getsignal(number)):
                handlers[number] = signal.signal(number, lambda number, _: noted.add(number))
    try:
        yield
    finally:
        for number in reversed(handlers):
            signal.signal(number, handlers[number])
        for missed in noted:
            signal.raise_signal(missed)


@contextmanager
def _ending(workers: dict[Connection, _Worker]) -> Iterator[set[int]]:
    """End all workers with this context, and with this process if that is asked to end.

    The set has what has interrupted this process.
    """
    interrupts: set[int] = set()

    def kill() -> None:
        for worker in workers.values():
            with suppress(ProcessLookupError):
                os.kill(worker.process, signal.SIGKILL)

    def end() -> None:
        kill()
        while workers:
            pipe, worker = workers.popitem()
            pipe.close()
            with suppress(ChildProcessError):
                os.waitpid(worker.process, 0)

    def ended(number: int, _: FrameType | None) -> None:
        end()
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)

    def interrupted(number: int, frame: FrameType | None) -> None:
        interrupts.add(number)
        kill()  # and no more: whoever is interrupted may be about to read from them
        assert callable(interrupt)
        interrupt(number, frame)

    interrupt = signal.getsignal(signal.SIGINT)
    before: dict[signal.Signals, Any] = {}
    with suppress(ValueError):  # not in the main thread
        for number in BY_A_PERSON[1:]:
            if signal.getsignal(number) is signal.SIG_DFL:
                before[number] = signal.signal(number, ended)
        if callable(interrupt):
            before[signal.SIGINT] = signal.signal(signal.SIGINT, interrupted)
    try:
        yield interrupts
    finally:
        try:
            with _held():  # a second interrupt must not keep any worker alive
                end()
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)
