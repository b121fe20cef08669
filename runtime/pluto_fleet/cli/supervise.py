"""`--supervise`: starts the app as another process, and again when it crashes."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass

from plutoc_runtime import output

GIVES_UP_AFTER = 6
"""Crashes in a row, with nothing finished in between."""

LONG_LIFE = 60.0
"""Seconds; who crashes later than that has got somewhere."""

PAUSES = (0.0, 0.5, 1.0, 5.0, 15.0, 30.0)
"""Seconds before each start in a row. The first is quick enough for drones to stay in the air."""

INTERNAL = 70

REFUSES = "PLUTO_REFUSES"
"""Where a supervised app finds the number of the file in which it says that it refuses to go on.

No exit code says so, for a hook can end the process with any; nor does a journal, for it may be the
journal that cannot be written.
"""

BAD_INPUT = 2

_SIGNALS = (signal.SIGHUP, signal.SIGINT, signal.SIGTERM)

ENDS, STOPS = (0, 1, 4), (*(128 + number for number in _SIGNALS), 141)
"""Exit codes of an app that meant to end: because all is over, and because it was told to."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Supervised:
    """What is started, and what to say of it."""

    name: str
    first: Sequence[str]
    """The command that sets out."""
    again: Callable[[], Sequence[str] | None]
    """The command that goes on; None: there is nothing yet to go on with."""
    finished: Callable[[], int]
    """How many trips and missions have ended: if it grows, the app gets somewhere."""
    over: Callable[[int], bool]
    """Whether it is true what an exit code says: a hook can end the process with any."""
    how_to_go_on: str
    pauses: Sequence[float] = PAUSES


def supervise(what: Supervised) -> int:
    """Keep an app running until its flight has ended; return the exit code of its last life."""
    watch = _Watch()
    with watch.listening():
        command, crashes, finished = what.first, 0, what.finished()
        while True:
            began = time.monotonic()
            code = watch.run(command)
            if code == BAD_INPUT and watch.refused:
                return code
            if code in (*ENDS, *STOPS) and (watch.asked or what.over(code)):
                return code
            done = what.finished()
            if done > finished or time.monotonic() - began > LONG_LIFE:
                crashes = 0
            crashes, finished = crashes + 1, max(done, finished)
            if watch.asked or crashes >= GIVES_UP_AFTER:
                return _given_up(what, code, crashes, watch.asked)
            output.tell(f"{what.name}: the app {_how(code)}: it is started again")
            watch.pause(what.pauses[min(crashes, len(what.pauses)) - 1])
            if watch.asked:
                return _given_up(what, code, crashes, watch.asked)
            command = what.again() or what.first


@dataclass(slots=True)
class _Watch:
    """The process that runs now, and who asked that all shall end."""

    asked: int = 0
    """The exit code for that; 0: it was not asked for."""
    refused: bool = False
    """Whether the process that ran last has said that it refuses to go on."""
    _child: subprocess.Popen[bytes] | None = None
    _bell: int = -1
    """A pipe's end: a byte in it wakes what waits at the other end."""
    _door: int = -1

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Pass signals on, for as long as this lasts."""
        before = {}
        self._door, self._bell = os.pipe()
        for number in _SIGNALS:
            if signal.getsignal(number) is not signal.SIG_IGN:  # as with nohup
                before[number] = signal.signal(number, self._told)
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)
            os.close(self._door)
            os.close(self._bell)

    def run(self, command: Sequence[str]) -> int:
        """Run a process to its end; one that a signal killed gives 128 and its number."""
        hears, says = os.pipe()
        os.set_blocking(hears, False)
        try:
            # A group of its own: Ctrl-C at the terminal reaches it through us alone, and once.
            self._child = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                process_group=0,
                pass_fds=[says],
                env={**os.environ, REFUSES: str(says)},
            )
            if self.asked:  # in the moment before there was a process to tell
                self._pass_on(signal.SIGTERM)
            code = self._child.wait()
            self.refused = _was_written(hears)
        finally:
            self._child = None
            os.close(hears)
            os.close(says)
        return 128 - code if code < 0 else code

    def pause(self, seconds: float) -> None:
        """Wait, unless all shall end."""
        select.select([self._door], [], [], seconds)

    def _told(self, number: int, _: object) -> None:
        self.asked = 128 + number
        os.write(self._bell, b"!")
        self._pass_on(signal.SIGINT if number == signal.SIGINT else signal.SIGTERM)

    def _pass_on(self, number: signal.Signals) -> None:
        if self._child is not None:
            with suppress(OSError):
                self._child.send_signal(number)


def refuse() -> None:
    """Say to this process's supervisor, if it has one, that it refuses to go on."""
    with suppress(KeyError, ValueError, OSError):
        os.write(int(os.environ[REFUSES]), b"!")


def _was_written(hears: int) -> bool:
    with suppress(BlockingIOError):
        return os.read(hears, 1) != b""
    return False


def _given_up(what: Supervised, code: int, crashes: int, asked: int) -> int:
    if asked:
        said = "it is not started again"
    else:
        said = f"that was {crashes} times in a row with nothing finished, so it stays down"
    output.tell(f"{what.name}: the app {_how(code)}; {said}\n{what.how_to_go_on}")
    return asked or INTERNAL


def _how(code: int) -> str:
    if code == INTERNAL:
        return f"crashed (exit code {code})"
    if code > 128:
        with suppress(ValueError):
            return f"was killed ({signal.Signals(code - 128).name})"
    return f"ended before its flight did (exit code {code})"
