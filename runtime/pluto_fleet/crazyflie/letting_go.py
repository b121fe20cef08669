"""How a link ends without a command to the drone.

cflib says goodbye with a setpoint of no thrust: a drone in the air falls, and one that has just landed
locks. So the drone's link is taken out and closed by itself first; what cflib still sends goes nowhere.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from threading import Lock, Thread, Timer
from time import sleep
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .borrowed import Cf, Link

_LONGEST = 1.5
"""Seconds that cflib's own threads take to see that they are to end."""
_SENDING = 2.5
"""Seconds that a packet may take to be sent, and more."""
_HANGS = 0.3
"""Seconds after which a driver that is to end must be waiting for a dongle that is gone."""


class Nowhere:
    """A link to nobody, for what cflib sends and expects while it is put away."""

    needs_resending = False

    def send_packet(self, _: object) -> bool:
        """Take something, and do nothing with it."""
        return True

    def receive_packet(self, _: float = 0.0) -> None:
        """Wait a moment, for nothing."""
        sleep(0.05)

    def close(self) -> None:
        """Be closed: there is nothing to close."""


def let_go(drone: str, cf: Cf | None, done: Callable[[], None]) -> None:
    """Put a connection away in a daemon thread, and say so there when it is done."""

    def work() -> None:
        if cf is not None:
            with suppress(Exception):  # whatever is wrong with it: nobody uses it any more
                _put_away(cf)
        done()

    Thread(target=work, name=f"letting go of {drone}", daemon=True).start()


def _put_away(cf: Cf) -> None:
    cf.incoming.stop()
    link, cf.link = cf.link, Nowhere()
    if link is not None and not isinstance(link, Nowhere):
        waking = Timer(_HANGS, _wake, (link,))
        waking.daemon = True
        waking.start()
        try:
            link.close()
        finally:
            waking.cancel()
    if cf.incoming.is_alive():
        cf.incoming.join(_LONGEST)
    _dismiss(cf)
    _cut(cf)
    cf.close_link()


def _dismiss(cf: Cf) -> None:
    """Let threads end that wait for an answer, or to ask again."""
    timers: dict[object, Timer] = getattr(cf, "_answer_patterns", {})
    for timer in list(timers.values()):
        timer.cancel()
    for entry in list(getattr(cf.incoming, "cb", ())):
        owner = getattr(entry.callback, "__self__", None)
        end = getattr(owner, "_close", None)
        if isinstance(owner, Thread) and end is not None:
            end()


def _cut(cf: Cf) -> None:
    """Take the link away while nobody sends, so that cflib says no goodbye even to nowhere.

    Whoever sends looks for a link and then uses it, under a lock. One that fell over while it sent has
    left it locked, and all others wait for ever: they are let in, and find no link.
    """
    lock: Lock | None = getattr(cf, "_send_lock", None)
    if lock is not None:
        lock.acquire(timeout=_SENDING)
    cf.link = None
    if lock is not None:
        with suppress(RuntimeError):  # whoever had it was only slow
            lock.release()


def _wake(link: Link) -> None:
    """Wake a driver's thread that waits for the answer of a dongle that is gone.

    It waits without a limit, and cflib for it: an answer that says nothing lets it see that it is to
    end. It may be at its first greeting, which it repeats.
    """
    answers = getattr(getattr(link, "_radio", None), "_rsp_queue", None)
    if answers is not None:
        for _ in range(20):
            answers.put(None)
