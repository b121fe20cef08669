"""Processes that answer questions beside this one, so that nothing waits here for what they take.

A thread would not do: it shares Python's lock with the event loop. One call that reads 60 MB of JSON keeps
that lock for a second, and what computes gives it back every 5 ms only, each time that the loop has
called a socket.
"""

from __future__ import annotations

import asyncio
import os
import pickle
import signal
import socket
import traceback
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection, Pipe
from typing import Concatenate, Generic, NoReturn, ParamSpec, Protocol, TypeVar, cast

from ..shared import output
from ..shared.domain.errors import ANY_ERROR
from .at_once import at_once
from .beside import Died
from .forked import leave, not_for_children, refused
from .workers import Raised, portable

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)
R = TypeVar("R")
P = ParamSpec("P")

PROCESSES = 3
"""The questions that are answered at the same time, each in a process of its own."""

NICE = 5
"""The priority of these processes, as `nice` counts: less than that of what flies."""


class Answers(Protocol[T_co]):
    """Answers questions about something that need not be in this process."""

    async def ask(
        self, question: Callable[Concatenate[T_co, P], R], /, *given: P.args, **named: P.kwargs
    ) -> R:
        """Return what a function of a module returns for it, or raise what that raises."""


class Apart(Generic[T]):
    """Answers in other processes.

    Make one before there are threads, an event loop, or open databases here: a copy of the process
    would have them too, and could use none. The copy that is made then waits, and makes those of itself
    that answer: the first question is for the first one, and only what is asked at the same time for another.
    """

    def __init__(self, what: T) -> None:
        self._asked, asked = socket.socketpair()
        output.flush()
        self._waits = os.fork()
        if self._waits == 0:
            self._asked.close()
            _wait(asked, what)
        asked.close()
        not_for_children(self._asked.fileno())
        self._places = asyncio.Semaphore(PROCESSES)
        self._idle: list[_Copy] = []

    async def ask(
        self, question: Callable[Concatenate[T, P], R], /, *given: P.args, **named: P.kwargs
    ) -> R:
        """Return what a function of a module returns there, or raise what it raises.

        `Died` tells that its process has ended before. Cancelling this gives the answer up.
        """
        async with self._places:
            copy = self._idle.pop() if self._idle else _Copy(self._asked)
            outcome = await copy.ask(question, given, named)
            self._idle.append(copy)
        if isinstance(outcome, Raised):
            outcome.error.add_note(outcome.trace)
            raise outcome.error
        return cast(R, outcome)

    def close(self) -> None:
        """End all of them, also in the midst of a question."""
        self._asked.close()
        with suppress(ChildProcessError):
            os.waitpid(self._waits, 0)


class _Copy:
    """A copy that answers one question after the other."""

    def __init__(self, asked: socket.socket) -> None:
        self._pipe, theirs = Pipe()
        not_for_children(self._pipe.fileno())
        with theirs, suppress(OSError):  # else it ends before it answers
            socket.send_fds(asked, [b"!"], [theirs.fileno()])

    async def ask(self, *question: object) -> object:
        """Return what it tells; if that is not heard to its end, it is to be asked no more."""
        try:
            self._pipe.send(question)
            return await at_once(self._pipe.recv)
        except (EOFError, OSError) as error:
            raise Died("has ended before it answered") from error
        except asyncio.CancelledError:
            self._let_go()
            raise

    def _let_go(self) -> None:
        # a thread reads from it: closing would leave that waiting, and give its number to another file
        with suppress(OSError), socket.socket(fileno=os.dup(self._pipe.fileno())) as pipe:
            pipe.shutdown(socket.SHUT_RDWR)


def _wait(asked: socket.socket, what: object) -> NoReturn:
    """Make a copy that answers for each pipe that comes, until the first process has gone; then end all."""
    try:
        os.setpgid(0, 0)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)  # the first process says when they end
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # nobody asks how one has ended
        os.nice(NICE)
        while True:
            _, pipes, *_ = socket.recv_fds(asked, 1, 1)
            if not pipes:
                break
            if os.fork() == 0:
                asked.close()
                with refused():
                    _answer(Connection(pipes[0]), what)
            os.close(pipes[0])
        os.killpg(0, signal.SIGKILL)
    finally:
        leave(0)


def _answer(pipe: Connection, what: object) -> NoReturn:
    """Answer what is asked through a pipe, until that is closed."""
    try:
        with suppress(EOFError, OSError):
            while True:
                pipe.send_bytes(_told(what, *pipe.recv()))
    finally:
        leave(0)


def _told(
    what: object,
    question: Callable[..., object],
    given: tuple[object, ...],
    named: dict[str, object],
) -> bytes:
    try:
        return pickle.dumps(question(what, *given, **named))
    except ANY_ERROR as error:
        trace = "".join(traceback.format_exception(error))
        return pickle.dumps(Raised(portable(error), trace))
