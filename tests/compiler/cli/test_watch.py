"""`plutoc watch` in a process of its own, and where it cannot watch; what it says is in sessions."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP, tree
from tests.kit.command import Process, plutoc

WATCH = ("-m", "plutoc", "watch", "crop.pluto")


@pytest.mark.skipif(os.name != "posix", reason="Windows has no such signals")
@pytest.mark.process
@pytest.mark.parametrize(
    ("number", "code", "last"),
    [
        (signal.SIGINT, 130, ""),
        pytest.param(signal.SIGTERM, 143, "plutoc: terminated\n", marks=pytest.mark.long),
        pytest.param(signal.SIGHUP, 129, "plutoc: terminated\n", marks=pytest.mark.long),
    ],
)
def test_saves_are_seen_until_a_signal_ends_it(
    app: Path, number: signal.Signals, code: int, last: str
) -> None:
    """A save in place, and one by a rename, as many editors do it."""
    with Process(*WATCH) as watching:
        watching.until("Ctrl-C ends")
        app.write_text(APP.replace("max_attempts: 3", "max_attempts: 5"))
        assert "now retried up to 5 times" in watching.until("~ src/crop/flow.py")
        Path("crop.pluto~").write_text(APP.replace("max_attempts: 3", "max_attempts: 7"))
        os.replace("crop.pluto~", app)
        assert "now retried up to 7 times" in watching.until("~ src/crop/flow.py")
        assert watching.ended(number) == (code, last)


def test_without_the_extra_it_is_said_what_to_install(
    app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing has begun then."""
    before = tree(Path())
    monkeypatch.setattr("plutoc.cli.watch.find_spec", lambda name: None)
    said = 'plutoc: watch needs the extra `editor`: pip install "plutoc[editor]"\n'
    assert plutoc("watch", app) == (2, "", said)
    assert tree(Path()) == before


def test_folders_that_cannot_be_watched_are_told(
    app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As where the system watches too many already."""

    def refusing(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("watchfiles.main.RustNotify", refusing)
    said = plutoc("watch", app)
    assert said.code == 2
    assert said.err.endswith("the files cannot be watched: No space left on device\n")
