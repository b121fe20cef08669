"""cflib, imported when a radio is opened and never before, and let go of without a command.

cflib is published under the GPL, version 3; what is written here are only the names of its parts. It
says goodbye with a setpoint of no thrust: a drone in the air falls, and one that has just landed
locks. So the drone's link is taken out and closed by itself first; what cflib still sends goes nowhere.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Callable
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from threading import Lock, Thread, Timer
from time import sleep
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import BadInput

from ..drones.errors import NotReady
from ..process.ipc import is_private
from ..scaffolding import app_package
from . import messages

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf
    from cflib.crtp.crtpstack import CRTPPacket

HIGH_LEVEL, SUPERVISOR, LOCALIZATION, PLATFORM, LINK_CONTROL = 8, 9, 6, 13, 15
"""Ports."""

_LOADING = Lock()


def require() -> None:
    """Raise `BadInput` with the line that installs it, where there is no cflib; imports nothing."""
    if find_spec("cflib") is None:
        raise BadInput(messages.no_cflib(_package()))


def load() -> None:
    """Import cflib and make its drivers ready; takes a second, and is called in a thread of its own."""
    with _LOADING:
        try:
            import cflib.crazyflie
            import cflib.crtp.radiodriver
        except ImportError as error:
            raise NotReady(f"{messages.no_cflib(_package())} ({error})") from error
        # what goes wrong is said here, in our words
        logging.getLogger("cflib").addHandler(logging.NullHandler())
        if not cflib.crtp.CLASSES:  # once a process: each time adds all drivers
            cflib.crtp.init_drivers()


def _package() -> str | None:
    """Return the package whose extra brings cflib, or None where this lies in no such package."""
    package = app_package()
    return None if package == "pluto_fleet" else package


def packet(port: int, channel: int, data: bytes) -> CRTPPacket:
    """Return a packet for what cflib has no function for."""
    from cflib.crtp.crtpstack import CRTPPacket

    made = CRTPPacket()
    made.set_header(port, channel)
    made.data = data
    return made


def forget_dead_radios() -> None:
    """Let a dongle be opened anew whose thread has ended: it was unplugged."""
    from cflib.crtp.radiodriver import RadioManager

    known: list[Thread | None] = getattr(RadioManager, "_radios", [])
    for place, radio in enumerate(known):
        if radio is not None and not radio.is_alive():
            RadioManager.remove(place)


_NAME = "crazyflie"


def cache_folder(flight: Path) -> str | None:
    """Return a folder for them: the user's own cache, else one of this flight, else None.

    cflib runs what it finds there, so no other user may write it.
    """
    with suppress(OSError, RuntimeError):  # there is no home folder
        given = os.environ.get("XDG_CACHE_HOME", "")
        base = Path(given) if os.path.isabs(given) else Path.home() / ".cache"
        folder = base / "pluto" / _NAME
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if folder.is_absolute() and is_private(folder) and os.access(folder, os.W_OK):
            return str(folder)
    with suppress(OSError):
        folder = flight / _NAME
        folder.mkdir(mode=0o700, exist_ok=True)
        if is_private(folder):
            return str(folder)
    return None


_LONGEST = 1.5
"""Seconds that cflib's own threads take to see that they are to end."""
_SENDING = 2.5
"""Seconds that a packet may take to be sent, and more."""
_HANGS = 0.3
"""Seconds after which a driver that is to end must be waiting for a dongle that is gone."""


class NullLink:
    """A link that ends nowhere, for what cflib sends and expects while it is put away."""

    needs_resending = False

    def send_packet(self, _: object) -> bool:
        """Take something, and do nothing with it."""
        return True

    def receive_packet(self, _: float = 0.0) -> None:
        """Wait a moment, for nothing."""
        sleep(0.05)

    def close(self) -> None:
        """Be closed: there is nothing to close."""


def release_link(drone: str, cf: Cf | None, done: Callable[[], None]) -> None:
    """Put a connection away in a daemon thread, and say so there when it is done."""

    def work() -> None:
        if cf is not None:
            with suppress(Exception):  # a broken connection is not used any more
                _put_away(cf)
        done()

    Thread(target=work, name=f"closing the link to {drone}", daemon=True).start()


def _put_away(cf: Cf) -> None:
    cf.incoming.stop()
    link, cf.link = cf.link, NullLink()
    if link is not None and not isinstance(link, NullLink):
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
    """Take the link away while nothing is sent, so that cflib says no goodbye even to nowhere.

    A sender looks for a link and then uses it, under a lock. One that fell over while it sent has
    left it locked, and all others wait for ever: they are let in, and find no link.
    """
    lock: Lock | None = getattr(cf, "_send_lock", None)
    if lock is not None:
        lock.acquire(timeout=_SENDING)
    cf.link = None
    if lock is not None:
        with suppress(RuntimeError):  # its holder was only slow
            lock.release()


def _wake(link: Any) -> None:
    """Wake a driver's thread that waits for the answer of a dongle that is gone.

    It waits without a limit, and cflib for it: an answer that says nothing lets it see that it is to
    end. It may be at its first greeting, which it repeats.
    """
    answers = getattr(getattr(link, "_radio", None), "_rsp_queue", None)
    if answers is not None:
        for _ in range(20):
            answers.put(None)
