"""cflib: imported only when a radio is opened, and closed without a command to the drone.

cflib is published under the GPL, version 3; only names of its parts are used here. When it closes a link it
sends a setpoint without thrust: a drone in the air falls, and one that has just landed locks. So the link
is removed and closed first, and what cflib still sends goes to a null link.
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

from ..drones.protocol import NotReady
from ..process.ipc import is_private
from ..shared.domain.errors import BadInput
from . import messages

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf
    from cflib.crtp.crtpstack import CRTPPacket

HIGH_LEVEL, SUPERVISOR, LOCALIZATION, PLATFORM, LINK_CONTROL = 8, 9, 6, 13, 15
"""Ports."""

_LOADING = Lock()


def require() -> None:
    """Raise `BadInput` with the command that installs cflib if it is missing; imports nothing."""
    if find_spec("cflib") is None:
        raise BadInput(messages.NO_CFLIB)


def load() -> None:
    """Import cflib and initialize its drivers; takes a second, in a thread of its own."""
    with _LOADING:
        try:
            import cflib.crazyflie
            import cflib.crtp.radiodriver
        except ImportError as error:
            raise NotReady(f"{messages.NO_CFLIB} ({error})") from error
        # errors are reported here
        logging.getLogger("cflib").addHandler(logging.NullHandler())
        if not cflib.crtp.CLASSES:  # once per process: each call adds all drivers
            cflib.crtp.init_drivers(enable_serial_driver=True)


def packet(port: int, channel: int, data: bytes) -> CRTPPacket:
    """Return a packet, where cflib has no function for it."""
    from cflib.crtp.crtpstack import CRTPPacket

    made = CRTPPacket()
    made.set_header(port, channel)
    made.data = data
    return made


def forget_dead_radios() -> None:
    """Make cflib open a dongle again whose thread has ended, as it was unplugged."""
    from cflib.crtp.radiodriver import RadioManager

    known: list[Thread | None] = getattr(RadioManager, "_radios", [])
    for place, radio in enumerate(known):
        if radio is not None and not radio.is_alive():
            RadioManager.remove(place)


_PACKETS = 100
"""How many packets in a row cflib sends in vain, in most of a second, until it takes a link for lost."""


def bear_silence(seconds: float) -> None:
    """Make links that are opened from now on outlast a silence."""
    import cflib.crtp.radiodriver

    cflib.crtp.radiodriver.set_retries_before_disconnect(round(_PACKETS * max(1.0, seconds)))


_NAME = "crazyflie"


def cache_folder(flight: Path) -> str | None:
    """Return a folder for cached tables: the user's own cache, else one of this flight, else None.

    cflib executes what it finds there, so no other user may write it.
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
"""Seconds that cflib's own threads take to end."""
_SENDING = 2.5
"""Ample seconds for sending a packet."""
_HANGS = 0.3
"""Seconds after which a driver that has not ended must be waiting for an unplugged dongle."""


class NullLink:
    """A null link, for what cflib sends and expects while it is being closed."""

    needs_resending = False

    def send_packet(self, _: object) -> bool:
        return True

    def receive_packet(self, _: float = 0.0) -> None:
        sleep(0.05)

    def close(self) -> None:
        """Do nothing."""


def release_link(drone: str, cf: Cf | None, done: Callable[[], None]) -> None:
    """Close a connection in a daemon thread, and call back from there when it is done."""

    def work() -> None:
        if cf is not None:
            with suppress(Exception):  # the connection is not used any more
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
    """End threads that wait for an answer, or to repeat a request."""
    timers: dict[object, Timer] = getattr(cf, "_answer_patterns", {})
    for timer in list(timers.values()):
        timer.cancel()
    for entry in list(getattr(cf.incoming, "cb", ())):
        owner = getattr(entry.callback, "__self__", None)
        end = getattr(owner, "_close", None)
        if isinstance(owner, Thread) and end is not None:
            end()


def _cut(cf: Cf) -> None:
    """Remove the link while nothing is being sent.

    A sender checks for a link and then uses it, under a lock. One that raised while sending has left
    it locked, and all others would wait for ever: the lock is released, and they find no link.
    """
    lock: Lock | None = getattr(cf, "_send_lock", None)
    if lock is not None:
        lock.acquire(timeout=_SENDING)
    cf.link = None
    if lock is not None:
        with suppress(RuntimeError):  # its holder has released it meanwhile
            lock.release()


def _wake(link: Any) -> None:
    """Wake a driver's thread that waits for the answer of an unplugged dongle.

    It waits without a time-out, and cflib for it: an empty answer makes it check whether to end. It
    may be at its initial handshake, which it repeats.
    """
    answers = getattr(getattr(link, "_radio", None), "_rsp_queue", None)
    if answers is not None:
        for _ in range(20):
            answers.put(None)
