"""`plutoc`, as a person types it: the sessions in the folder `sessions`."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from plutoc.cli import main
from tests.kit.session import check_session, sessions
from tests.kit.shell import Shell

SESSIONS = Path(__file__).parent / "sessions"


@pytest.fixture(autouse=True)
def saves(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let `watch` see what its standard input says to do to files, and an interrupt at its end."""

    def watch(*folders: Path, **_: object) -> Iterator[set[str]]:
        while line := sys.stdin.readline():
            for command in line.strip().split("; "):
                Shell({}, Path(), monkeypatch).typed(command)
            yield {"a save"}
            yield set()  # and nothing for a while
        raise KeyboardInterrupt

    monkeypatch.setattr("watchfiles.watch", watch)


@pytest.mark.parametrize("session", sessions(SESSIONS))
def test_what_is_typed_prints_what_is_written(session: Path, update: bool, tmp_path: Path) -> None:
    """With the exit codes, and the files that come of it."""
    check_session(session, {"plutoc": main}, update, tmp_path, masked)


def masked(text: str) -> str:
    """Leave out how many files a package has: there are more of them now and then."""
    return re.sub(r"a new package of \d+ files", "a new package of … files", text)
