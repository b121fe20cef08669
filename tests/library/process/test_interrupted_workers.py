"""Ctrl-C while a worker is forked: it counts once that has been done, and is neither lost nor told as an error."""

from __future__ import annotations

import pytest

from tests.kit.command import python

pytestmark = [pytest.mark.long, pytest.mark.process]

SCRIPT = """
import os, select, signal, sys, threading

def blocked(number):
    signal.pthread_kill(threading.get_ident(), number)

def elsewhere(number):
    '''Let another thread receive it, and wait until it has: Python calls the handler in this one.'''
    reads, writes = os.pipe()
    os.set_blocking(writes, False)
    before = signal.set_wakeup_fd(writes)
    signal.pthread_kill(other.ident, number)
    select.select([reads], [], [])
    signal.set_wakeup_fd(before)

def strike():
    send, numbers = signals
    for number in numbers:
        send(number)

def quits(number, frame):
    raise SystemExit("told to quit")

os.register_at_fork(before=strike)  # those that are registered later are called earlier
from pluto_fleet.process.workers import in_workers

other = threading.Thread(target=threading.Event().wait, daemon=True)
other.start()
send, *names = sys.argv[1:]
signals = {"blocked": blocked, "elsewhere": elsewhere}[send], [getattr(signal, n) for n in names]
signal.signal(signal.SIGHUP, quits)
try:
    list(in_workers(lambda _: signal.pause(), [1, 2], 2))
    print("lost")
except KeyboardInterrupt:
    print("interrupted")
except SystemExit as end:
    print(end)
after = signal.getsignal(signal.SIGINT) is signal.default_int_handler
after &= signal.getsignal(signal.SIGHUP) is quits
after &= not signal.pthread_sigmask(signal.SIG_BLOCK, ())
print("as before" if after else "changed")
try:
    while os.waitpid(-1, 0):
        print("a worker is left")
except ChildProcessError:
    pass
"""


def said(*arguments: str) -> list[str]:
    """Return what a process prints that is sent signals while it forks."""
    # `ignore`: from 3.12 on, Python warns of forks where there are threads
    ran = python("-W", "ignore", "-c", SCRIPT, *arguments)
    assert (ran.code, ran.err) == (0, "")
    return ran.out.splitlines()


@pytest.mark.parametrize("send", ["blocked", "elsewhere"])
def test_an_interrupt_during_a_fork_is_raised_after_it(send: str) -> None:
    """By the main thread's own signal, and by one that reaches another thread."""
    assert said(send, "SIGINT") == ["interrupted", "as before"]


@pytest.mark.parametrize("send", ["blocked", "elsewhere"])
def test_so_is_what_another_handler_raises(send: str) -> None:
    """An app may have its own for the end of its terminal."""
    assert said(send, "SIGHUP") == ["told to quit", "as before"]
