"""What a process forked by a hook must not inherit, and the guard against `os._exit` in hooks.

A forked child is a copy of the app with everything open. What it inherits would outlive the app: a
lock that is never released, a connection that looks alive. And no child may run the app a second time.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import NoReturn, TypeVar

leave = os._exit
"""The real one, for ourselves."""


@contextmanager
def refused() -> Iterator[None]:
    """Make `os._exit` raise `SystemExit` within this context, so that the caller can be named."""
    instead_of(_refuse)
    try:
        yield
    finally:
        os._exit = leave


def instead_of(call: Callable[[int], NoReturn]) -> None:
    """Call this whenever something in this process calls `os._exit`."""
    process = os.getpid()

    def end(status: int) -> NoReturn:
        if os.getpid() == process:
            call(status)
        leave(status)

    os._exit = end


def _refuse(status: int) -> NoReturn:
    raise SystemExit(f"os._exit({status})")


T = TypeVar("T")

_lets_go: dict[object, Callable[[], object]] = {}
"""What a child calls first, by key."""

_files: dict[int, tuple[int, int]] = {}
"""Open files that no child may inherit, with their identity: a descriptor may have been reused."""


def in_children(call: Callable[[], object]) -> Callable[[], None]:
    """Make every child that is forked from now on call this first; return a function that ends that."""
    key = object()
    _lets_go[key] = call

    def no_more() -> None:
        _lets_go.pop(key, None)

    return no_more


def not_for_children(descriptor: int) -> None:
    """Keep children that are forked from now on from inheriting an open file, lock or connection."""
    _files[descriptor] = _identity(descriptor)


def deaf() -> None:
    """Reset signal handling in a child: its signals must not wake the parent's loop."""
    signal.set_wakeup_fd(-1)
    for number in _SIGNALS:
        signal.signal(number, signal.SIG_DFL)


def _identity(descriptor: int) -> tuple[int, int]:
    found = os.fstat(descriptor)
    return found.st_dev, found.st_ino


_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_RAISES = signal.default_int_handler


def _wait_for_signals() -> None:
    """Block signals in this thread while it forks, until the child has dropped its parent's handlers."""
    _before.mask = signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)


def _take_signals() -> None:
    signal.pthread_sigmask(signal.SIG_SETMASK, _before.mask)


_before = threading.local()


def _let_go() -> None:
    """Clean up in the child, before anything else runs in it."""
    for call in reversed(tuple(_lets_go.values())):  # what was set last is put back first
        call()
    for descriptor, which in _files.items():
        with suppress(OSError):  # it is closed already
            if _identity(descriptor) == which:
                _put_nothing(descriptor)
    _lets_go.clear()
    _files.clear()
    if signal.SIGINT in signal.sigpending() and signal.getsignal(signal.SIGINT) is _RAISES:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # what is raised in here, Python drops
    _take_signals()


def _put_nothing(descriptor: int) -> None:
    """Replace a file by the null device: its descriptor stays taken, so a second close is harmless."""
    nothing = os.open(os.devnull, os.O_RDWR | os.O_CLOEXEC)
    os.dup2(nothing, descriptor, inheritable=False)
    os.close(nothing)


os.register_at_fork(before=_wait_for_signals, after_in_parent=_take_signals, after_in_child=_let_go)


def end_if_forked(parent: int, error: BaseException | None = None) -> None:
    """End this process if it is a forked copy of the process with this number.

    `error`: what the hook raised in the copy.
    """
    if os.getpid() == parent:
        return
    if isinstance(error, StopIteration):  # a coroutine's end
        error = None
    code: object = error.code if isinstance(error, SystemExit) else error
    if code is not None and not isinstance(code, int):
        with suppress(OSError):
            print(f"a process that a hook has forked ends: {type(code).__name__}", file=sys.stderr)
        code = 1
    leave((code or 0) & 0xFF)
