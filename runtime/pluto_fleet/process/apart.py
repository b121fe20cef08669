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
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from multiprocessing.connection import Connection, Pipe
from typing import Concatenate, Generic, ParamSpec, Protocol, TypeVar, cast

from .at_once import at_once
from .copies import Died, Raised, forked, hear_signals, outcome
from .forked import not_for_children

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
        self._waits = forked(partial(_wait, self._asked, asked, what))
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


def _wait(asks: socket.socket, asked: socket.socket, what: object) -> None:
    """Make a copy that answers for each pipe that comes, until the first process has gone; then end all."""
    asks.close()
    os.setpgid(0, 0)
    hear_signals(signal.SIG_IGN)  # the first process says when they end
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # how one has ended is of no use here
    os.nice(NICE)
    while pipes := socket.recv_fds(asked, 1, 1)[1]:
        forked(partial(_answer, asked, pipes[0], what))
        os.close(pipes[0])
    os.killpg(0, signal.SIGKILL)


def _answer(asked: socket.socket, descriptor: int, what: object) -> None:
    """Answer what is asked through a pipe, until that is closed."""
    asked.close()
    pipe = Connection(descriptor)
    with suppress(EOFError, OSError):
        while True:
            question, given, named = pipe.recv()
            told = outcome(lambda: pickle.dumps(question(what, *given, **named)))  # noqa: B023
            pipe.send_bytes(pickle.dumps(told) if isinstance(told, Raised) else told)
