"""`--supervise`: runs the app in another process, and restarts it when it crashes."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass

from ..shared import output

GIVES_UP_AFTER = 6
"""Crashes in a row, with no progress in between, before it gives up."""

LONG_LIFE = 60.0
"""Seconds; a process that crashes later than that has made progress."""

PAUSES = (0.0, 0.5, 1.0, 5.0, 15.0, 30.0)
"""Seconds before each restart in a row; after the first, drones can still be in the air."""

INTERNAL = 70

REFUSES = "PLUTO_REFUSES"
"""The environment variable with the descriptor on which a supervised app says that it refuses to resume.

An exit code cannot say so, as a hook can exit with any; nor can the journal, which may be what
cannot be written.
"""

BAD_INPUT = 2

_SIGNALS = (signal.SIGHUP, signal.SIGINT, signal.SIGTERM)

ENDS, STOPS = (0, 1, 4), (*(128 + number for number in _SIGNALS), 141)
"""Exit codes of an app that ended regularly: because all missions have ended, or because it was stopped."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Supervised:
    """The process to supervise."""

    name: str
    first: Sequence[str]
    """The command of the first start."""
    again: Callable[[], Sequence[str] | None]
    """Returns the command of a restart; None: there is nothing to resume yet."""
    finished: Callable[[], int]
    """Returns how many trips and missions have ended: the measure of progress."""
    over: Callable[[int], bool]
    """Returns whether an exit code is confirmed: a hook can exit with any."""
    how_to_go_on: str
    pauses: Sequence[float] = PAUSES


def supervise(what: Supervised) -> int:
    """Keep an app running until its flight has ended; return the last process's exit code."""
    watch = _Watch()
    with watch.listening():
        command, crashes, finished = what.first, 0, what.finished()
        while True:
            began = time.monotonic()
            code = watch.run(command)
            if code == BAD_INPUT and watch.refused:
                return code
            if code in (*ENDS, *STOPS) and (watch.asked or what.over(code)):
                return watch.asked if code in STOPS and watch.asked else code
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
    """The running process, and the signals that ask for its end."""

    asked: int = 0
    """The exit code for the signal received; 0: none."""
    refused: bool = False
    """Whether the last process has said that it refuses to resume."""
    _child: subprocess.Popen[bytes] | None = None
    _bell: int = -1
    """The write end of a pipe that wakes up `pause`."""
    _door: int = -1

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Forward signals to the process within this context."""
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
        """Run a process to its end; for one killed by a signal return 128 plus the signal."""
        hears, says = os.pipe()
        os.set_blocking(hears, False)
        try:
            # A process group of its own: Ctrl-C at the terminal reaches it once, through us.
            self._child = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                process_group=0,
                pass_fds=[says],
                env={**os.environ, REFUSES: str(says)},
            )
            if self.asked:  # just before there was a process to signal
                self._pass_on(signal.SIGTERM)
            code = self._child.wait()
            self.refused = _was_written(hears)
        finally:
            self._child = None
            os.close(hears)
            os.close(says)
        return 128 - code if code < 0 else code

    def pause(self, seconds: float) -> None:
        """Wait, unless the end is requested."""
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
    """Tell this process's supervisor, if there is one, that it refuses to resume."""
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
