"""Flights as real processes: started, killed, and resumed until they are over."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from pluto_fleet.drones.connection import RECONNECT_LIMIT
from pluto_fleet.journal.place import commands_note
from tests.kit.command import Ran, environment, python

PATIENCE = RECONNECT_LIMIT + 60.0
"""Seconds until a life that does not end is called a failure: a lost link is waited for."""


@dataclass(slots=True, kw_only=True)
class Lives:
    """The lives of an app in a folder: the first flies, the next ones go on from its journal."""

    app: str
    source: Path
    """The folder that the app's package is imported from."""
    folder: Path
    """Where its journal and its two files are."""
    lives: list[str] = field(default_factory=list)
    """What each life has printed."""
    life: subprocess.Popen[bytes] | None = None
    """The one that is being lived."""

    @property
    def journal(self) -> Path:
        """Where it is written down."""
        return self.folder / "flight.journal"

    @property
    def files(self) -> list[str]:
        """Its two files, as `fly` is told of them."""
        return [str(self.folder / "missions.toml"), "--fleet", str(self.folder / "fleet.toml")]

    @property
    def told(self) -> str:
        """All that was said."""
        return "\n".join([*self.lives, *([self.printed] if self._file.exists() else [])])

    @property
    def printed(self) -> str:
        """What the life has printed until now."""
        return self._file.read_text(errors="replace")

    @property
    def pid(self) -> int:
        assert self.life is not None
        return self.life.pid

    def begin(self, *words: str) -> None:
        """Let a life begin with a command of the app."""
        command, env = [sys.executable, "-m", self.app, *words], environment(**self._own)
        with self._file.open("wb") as out:
            self.life = subprocess.Popen(command, env=env, stdout=out, stderr=subprocess.STDOUT)

    def kill(self) -> bool:
        """Kill the life as nothing can be kept from; False: it had ended by itself."""
        assert self.life is not None
        if self.life.poll() is None:
            os.kill(self.life.pid, signal.SIGKILL)
        killed = self.life.wait() == -signal.SIGKILL
        self._over()
        return killed

    def wait(self, seconds: float) -> int | None:
        """Return the exit code if the life ends within so many seconds."""
        assert self.life is not None
        try:
            code = self.life.wait(seconds)
        except subprocess.TimeoutExpired:
            return None
        self._over()
        return code

    def see_through(self, seconds: float = PATIENCE) -> int:
        """Return the exit code of a life that is not killed."""
        code = self.wait(seconds)
        if code is None:
            self.kill()
            raise AssertionError(f"it does not end: {self.folder}\n{self.told}")
        return code

    def run(self, *words: str) -> Ran:
        return python("-m", self.app, *words, cwd=None, **self._own)

    def end(self) -> None:
        """Leave no life behind."""
        if self.life is not None:
            self.kill()

    @property
    def _own(self) -> dict[str, str]:
        """Return what its processes have of the environment that others have not."""
        state = str(self.folder / "state")
        return {"PYTHONPATH": str(self.source), "XDG_STATE_HOME": state, "FLIGHT": str(self.folder)}

    @property
    def _file(self) -> Path:
        return self.folder / f"life{len(self.lives)}.txt"

    def _over(self) -> None:
        self.life = None
        self.lives.append(self.printed)


@dataclass(slots=True, kw_only=True)
class Flight(Lives):
    """Flies simulated drones."""

    speed: float
    chance: list[str] = field(default_factory=list)
    """What goes wrong besides, as `fly` is told so."""
    _heard: int = 0

    def start(self, *more: str) -> None:
        """Let a life begin: the first, or one that goes on where the last one was killed."""
        words = ["resume", str(self.journal)]
        if not self.journal.exists():
            flags = ["--sim", "--speed", str(self.speed), "--journal", str(self.journal)]
            words = ["fly", *self.files, *flags, *self.chance]
        self._heard = self._hears()
        self.begin(*words, *more)

    def signal(self, number: signal.Signals) -> None:
        os.kill(self.pid, number)

    def until_it_flies(self) -> None:
        """Wait until the life commands drones, or has ended."""
        life = self.life
        assert life is not None
        eventually(lambda: self._hears() != self._heard or life.poll() is not None)

    def _hears(self) -> int:
        """Return when the life, or the one before, has said how commands reach it; 0: none has."""
        note = commands_note(self.journal)
        with suppress(OSError):
            return note.stat().st_mtime_ns
        return 0

    def until_it_says(self, what: str) -> None:
        """Wait until the life has printed this."""
        if not eventually(lambda: what in self.printed):
            raise AssertionError(f"{what!r} was not said:\n{self.printed}")


def eventually(holds: Callable[[], bool], seconds: float = 60.0) -> bool:
    """Wait until something holds; False: it does not in that time."""
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def alive(pid: int) -> bool:
    """Return whether a process runs; one that is dead and not yet buried does not."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"
