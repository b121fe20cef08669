"""`plutoc watch`, as a person leaves it running beside an editor."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from typing import Self

import pytest

from tests.compiler.cli.conftest import APP, Call, tree

FIVE = APP.replace("max_attempts: 3", "max_attempts: 5")
SEVEN = APP.replace("max_attempts: 3", "max_attempts: 7")
MISTAKE = APP.replace("find_blooms)", "find_bloom)")
LONG_ENOUGH = 120
"""Seconds, for a machine with other work: a test that waits so long has failed."""


class Watching:
    """A `plutoc watch` in a process of its own, and what it has said."""

    def __init__(self, *words: str) -> None:
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
        self.process = subprocess.Popen(
            [sys.executable, "-m", "plutoc", "watch", *words],
            env=environment,
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
            assert line is not None, f"it has ended:\n{said}"
            said += line
            if words in line:
                return said

    def ended(self, number: signal.Signals) -> tuple[int, str]:
        """Send a signal; return the exit code, and what it says from here to its end."""
        self.process.send_signal(number)
        code = self.process.wait(timeout=LONG_ENOUGH)
        said = ""
        while (line := self._lines.get(timeout=LONG_ENOUGH)) is not None:
            said += line
        return code, said


@pytest.fixture
def watching(app: Path) -> Iterator[Watching]:
    """The app is watched, and was compiled once."""
    with Watching("crop.pluto") as one:
        one.until("Ctrl-C ends")
        yield one


def flow() -> str:
    return Path("crop/src/crop/flow.py").read_text()


def renamed(text: str) -> None:
    """Save the app as many editors do: aside, and by a rename."""
    Path("crop.pluto~").write_text(text)
    os.replace("crop.pluto~", "crop.pluto")


def test_what_a_save_changes_in_meaning_is_said(watching: Watching, app: Path) -> None:
    """And the package is compiled: by a save in place, and by one with a rename."""
    assert "max_attempts=3" in flow()
    app.write_text(FIVE)
    said = watching.until("~ src/crop/flow.py")
    assert "before → crop.pluto: 1 change in meaning\n" in said
    assert "  * a FAILED mission is now retried up to 5 times" in said
    assert "- before:13: retry = PriorityManager(max_attempts: 3)" in said
    assert "+ crop.pluto:13: retry = PriorityManager(max_attempts: 5)" in said
    assert "max_attempts=5" in flow()
    renamed(SEVEN)
    assert "now retried up to 7 times" in watching.until("~ src/crop/flow.py")
    assert "max_attempts=7" in flow()
    renamed(f"{SEVEN}# A word.\n")
    assert "before → crop.pluto: nothing changed in meaning" in watching.until("up to date")


@pytest.mark.skipif(os.name != "posix", reason="Windows has no such signals")
def test_ctrl_c_ends_it_quietly(watching: Watching) -> None:
    assert watching.ended(signal.SIGINT) == (130, "")


@pytest.mark.skipif(os.name != "posix", reason="Windows has no such signals")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_who_is_told_to_end_says_so(watching: Watching, number: signal.Signals) -> None:
    """As every command does."""
    assert watching.ended(number) == (128 + number, "plutoc: terminated\n")


def test_the_last_good_package_stays(watching: Watching, app: Path, plutoc: Call) -> None:
    """A mistake is told as `check` tells it; what comes after is compared with what was good."""
    before = tree(Path("crop"))
    app.write_text(MISTAKE)
    said = watching.until("tells more")
    assert said == f"\n{plutoc('check', 'crop.pluto').err}"
    assert tree(Path("crop")) == before
    app.write_text(FIVE)
    said = watching.until("~ src/crop/flow.py")
    assert "now retried up to 5 times" in said and "before, up to 3 times" in said
    app.write_bytes(b"\xff")
    assert watching.until("UTF-8") == "\nplutoc: crop.pluto is not UTF-8 text: see line 1\n"
    app.write_text(SEVEN)
    assert "before, up to 5 times" in watching.until("~ src/crop/flow.py")


def test_an_app_with_a_mistake_is_waited_for(app: Path) -> None:
    """It is watched from the beginning, and its own hooks.py from when it can be read."""
    app.write_text(MISTAKE)
    with Watching("crop.pluto", "-o", "out") as watching:
        assert "error[P1" in watching.until("Ctrl-C ends")
        assert not Path("out").exists()
        app.write_text(APP)
        assert "changed in meaning" not in watching.until("out: a new package")
        Path("out/src/crop/hooks.py").write_text("def find_blooms(mission): ...\n")
        assert "error[P3" in watching.until("tells more")


def test_a_file_that_was_deleted_and_comes_back_is_compiled(watching: Watching, app: Path) -> None:
    """That it is gone is said once."""
    app.unlink()
    assert watching.until("gone") == "crop.pluto is gone: waiting for it\n"
    renamed(FIVE)
    assert "now retried up to 5 times" in watching.until("~ src/crop/flow.py")


def test_a_hand_edit_is_refused_and_watching_goes_on(watching: Watching, app: Path) -> None:
    """As `compile` refuses it; once the edit is undone, the next save is compiled."""
    generated = Path("crop/src/crop/flow.py")
    before = generated.read_text()
    generated.write_text(f"{before}# mine\n")
    app.write_text(FIVE)
    assert "error[P4001]: `crop/src/crop/flow.py` was edited by hand" in watching.until("P4001` ")
    assert generated.read_text() == f"{before}# mine\n"
    generated.write_text(before)
    os.utime(app)  # saved again, as it is
    assert "now retried up to 5 times" in watching.until("~ src/crop/flow.py")


@pytest.mark.parametrize("name", ["hooks.py", "crop/src/crop/hooks.py"])
def test_a_saved_hooks_py_is_compiled(plutoc: Call, app: Path, name: str) -> None:
    """The one beside the app until the package has its own, and then that."""
    if "/" in name:
        assert plutoc("compile", app).code == 0
    Path(name).write_text("def pollinate(): ...\n")
    with Watching("crop.pluto") as watching:
        assert "error[" in watching.until("Ctrl-C ends")
        Path(name).write_text("def find_blooms(mission): ...\n")
        said = watching.until("tells more")
        assert f"--> {name}:1" in said and "find_blooms" in said
        assert "in meaning" not in said


def test_a_burst_of_saves_is_one_compile(watching: Watching, app: Path) -> None:
    """The last one counts."""
    for attempts in range(20, 70):
        renamed(APP.replace("max_attempts: 3", f"max_attempts: {attempts}"))
    said = watching.until("up to 69 times")
    # one compile, but for each time that this process had to wait between two of its fifty saves
    assert said.count("change in meaning") < 25


def test_without_the_extra_it_is_said_what_to_install(
    plutoc: Call, app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing has begun then."""
    before = tree(Path())
    monkeypatch.setattr("plutoc.cli.watch.find_spec", lambda name: None)
    said = plutoc("watch", app)
    assert (said.code, said.out) == (2, "")
    assert said.err == 'plutoc: watch needs the extra `editor`: pip install "plutoc[editor]"\n'
    assert tree(Path()) == before


def test_what_cannot_be_read_at_first_is_not_watched(plutoc: Call, here: Path) -> None:
    """It is likely to be a slip."""
    for name, why in {"none.pluto": "there is no file", "missions.toml": "is no app"}.items():
        said = plutoc("watch", name)
        assert said.code == 2
        assert why in said.err


def test_folders_that_cannot_be_watched_are_told(
    plutoc: Call, app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As where the system watches too many already."""

    def refusing(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("watchfiles.main.RustNotify", refusing)
    said = plutoc("watch", app)
    assert said.code == 2
    assert said.err.endswith("the files cannot be watched: No space left on device\n")
