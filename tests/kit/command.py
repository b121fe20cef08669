"""Command lines: called in this process, or as processes of their own.

`run` is for nearly everything: it calls a program's main function and gives what a shell would see.
`python` and `Process` start a real process; a test that does so is marked `process`.
Sentences that commands print belong into sessions (`tests/kit/session.py`), not into assertions.
"""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from typing import IO, Any, NamedTuple, Self

import pytest

from plutoc.cli import main as plutoc_main

Program = Callable[[Sequence[str]], int]
"""A main function: it takes the words after the program's name, and returns an exit code."""

LONG_ENOUGH = 120.0
"""Seconds, for a machine with other work: a process that takes longer hangs."""

UNSET = ("NO_COLOR", "FORCE_COLOR", "PLUTO_DEBUG", "COLUMNS")
"""What a developer may have set, and no command line of a test is to see."""


class Ran(NamedTuple):
    """What a command line ended with, and what it printed."""

    code: int
    out: str
    err: str


def run(
    program: Program,
    *words: object,
    given: str | bytes = b"",
    env: Mapping[str, str] | None = None,
) -> Ran:
    """Call a program in this process; what it and its children print is kept apart from ours."""
    data = given.encode() if isinstance(given, str) else given
    with pytest.MonkeyPatch.context() as patch:
        for name in UNSET:
            patch.delenv(name, raising=False)
        for name, value in (env or {}).items():
            patch.setenv(name, value)
        patch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data), encoding="utf-8"))
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            with _redirected("stdout", 1, out), _redirected("stderr", 2, err):
                try:
                    code = program([str(word) for word in words])
                except SystemExit as end:
                    code = end.code if isinstance(end.code, int) else int(end.code is not None)
            return Ran(code, _text(out), _text(err))


@contextmanager
def _redirected(name: str, number: int, file: IO[bytes]) -> Iterator[None]:
    """Lead a stream of this process, and its descriptor for children, into a file."""
    ours = getattr(sys, name)
    ours.flush()
    kept = os.dup(number)
    os.dup2(file.fileno(), number)
    with open(os.dup(file.fileno()), "w", encoding="utf-8") as stream:
        setattr(sys, name, stream)
        try:
            yield
        finally:
            setattr(sys, name, ours)
            os.dup2(kept, number)
            os.close(kept)


def _text(file: IO[bytes]) -> str:
    file.seek(0)
    return file.read().decode("utf-8", "backslashreplace")


def plutoc(*words: object, given: str | bytes = b"", env: Mapping[str, str] | None = None) -> Ran:
    """Call `plutoc` in this process."""
    return run(plutoc_main, *words, given=given, env=env)


def environment(**more: str) -> dict[str, str]:
    """What a process is started with that is to import what we import."""
    ours = {name: value for name, value in os.environ.items() if name not in UNSET}
    return {**ours, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), **more}


def python(*words: object, given: str = "", cwd: Path | None = None, **env: str) -> Ran:
    """Run Python to its end in a process of its own: `python("-m", "plutoc", ...)`."""
    return command(sys.executable, *words, given=given, cwd=cwd, **env)


def command(*words: object, given: str = "", cwd: Path | None = None, **env: str) -> Ran:
    """Run any program to its end in a process of its own."""
    done = subprocess.run(
        [str(word) for word in words],
        env=environment(**env),
        cwd=cwd,
        input=given,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
        timeout=LONG_ENOUGH,
    )
    return Ran(done.returncode, done.stdout, done.stderr)


class Process:
    """A Python program in a process of its own, whose lines are read as they come.

    Standard error is read with standard output. It is killed at the end of the `with`.
    """

    def __init__(self, *words: object, cwd: Path | None = None, **env: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, *(str(word) for word in words)],
            env=environment(**env),
            cwd=cwd,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self._lines: Queue[str | None] = Queue()
        self._reader = Thread(target=self._read)
        self._reader.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self._reader.join()
        self.process.__exit__(None, None, None)

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line)
        self._lines.put(None)

    def until(self, words: str) -> str:
        """Return what it says until a line with these words, which is included."""
        said = ""
        while True:
            try:
                line = self._lines.get(timeout=LONG_ENOUGH)
            except Empty:
                pytest.fail(f"{words!r} was not said, only:\n{said}")
            assert line is not None, f"it has ended, before {words!r}:\n{said}"
            said += line
            if words in line:
                return said

    def send(self, number: signal.Signals) -> None:
        """Send it a signal."""
        self.process.send_signal(number)

    def ended(self, number: signal.Signals | None = None) -> tuple[int, str]:
        """Send a signal, if there is one; return the exit code, and what is said from here to the end."""
        if number is not None:
            self.send(number)
        code = self.process.wait(timeout=LONG_ENOUGH)
        said = ""
        while (line := self._lines.get(timeout=LONG_ENOUGH)) is not None:
            said += line
        return code, said


def hearing(number: signal.Signals, how: signal.Handlers, *words: object, **more: Any) -> Process:
    """Start a Python program for which its caller has a signal ignored, as `nohup` has, or not."""
    script = (
        "import os, signal, sys; signal.signal(int(sys.argv[1]), signal.Handlers(int(sys.argv[2])));"
        " os.execv(sys.executable, [sys.executable, *sys.argv[3:]])"
    )
    return Process("-c", script, int(number), int(how), *words, **more)
