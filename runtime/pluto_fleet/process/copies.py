"""Forked copies of this process: how they begin and end, and what they send back of an error.

A copy has all that is loaded here, an app's hooks included, and takes nothing back.
"""

from __future__ import annotations

import os
import pickle
import signal
import traceback
import warnings
from collections.abc import Callable
from contextlib import suppress
from typing import Any, NamedTuple, TypeVar

from ..shared import output
from ..shared.domain.errors import ANY_ERROR
from .forked import leave, refused

R = TypeVar("R")

BY_A_PERSON = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""The signals that ask a process to end."""


class Died(Exception):
    """A copy has ended before its task: it was killed, or a hook has crashed the interpreter."""


class Raised(NamedTuple):
    """What a copy sends instead of a result."""

    error: BaseException
    trace: str


def forked(work: Callable[[], object]) -> int:
    """Do this in a copy, which then leaves: nothing returns there. Return its number."""
    output.flush()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # threads of hooks and event loops
        process = os.fork()
    if process == 0:
        code = 1
        try:
            with refused():
                work()
            code = 0
        finally:
            leave(code)
    return process


def outcome(work: Callable[[], R]) -> R | Raised:
    """Return what comes of this, as it can be sent."""
    try:
        return work()
    except ANY_ERROR as error:
        return Raised(_portable(error), "".join(traceback.format_exception(error)))


def _portable(error: BaseException) -> BaseException:
    """Return an error that another process can read."""
    with suppress(*ANY_ERROR):  # its class may be a hook's own
        if type(pickle.loads(pickle.dumps(error))) is type(error):
            return error
    return RuntimeError(f"{type(error).__name__}: {error}")


def hear_signals(handler: Any) -> None:
    """Set this handler for the signals that ask this process to end."""
    for number in BY_A_PERSON:
        if signal.getsignal(number) is not signal.SIG_IGN:  # as with nohup
            signal.signal(number, handler)


def reaped(process: int) -> str:
    """Wait for the end of a copy, and return how it ended."""
    return how_it_ended(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]))


def how_it_ended(status: int) -> str:
    """Return how a process with this exit code has ended."""
    if status >= 0:
        return f"ended by itself with exit code {status}"
    try:
        return f"was killed by {signal.Signals(-status).name}"
    except ValueError:
        return f"was killed by signal {-status}"
