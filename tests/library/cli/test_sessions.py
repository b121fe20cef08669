"""An app's program, as a person types it: the sessions in the folder `sessions`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from pluto_fleet.cli import drones as drones_command
from pluto_fleet.cli import main
from tests.kit.session import check_session, sessions
from tests.library.cli.fake_drones import ASKED, RECORD, THERE, at
from tests.library.files.an_app import APP


def alfalfa(words: Sequence[str]) -> int:
    """The program of the app."""
    return main(APP, words)


@pytest.fixture(autouse=True)
def there(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """Let some drones be there, and let those that are not there not be waited for."""
    monkeypatch.setattr(drones_command, "CONNECT_WITHIN", 0.05)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    RECORD.clear()
    THERE.clear()
    THERE["fake://1"] = at((0.52, 0.481, 0.01))
    THERE["fake://4"] = at((1.5, 2.0, 0.0), voltage=3.1)
    THERE["fake://9"] = at((-0.3, 1.0, 0.0))
    THERE["fake://10"] = at((1.5, 2.1, 0.0))
    yield
    assert {what for _, what in RECORD} <= ASKED  # no matter what was typed, nothing has moved


@pytest.mark.parametrize("session", sessions(Path(__file__).parent / "sessions"))
def test_what_is_typed_prints_what_is_written(session: Path, update: bool, tmp_path: Path) -> None:
    """With the exit codes, and the files that come of it."""
    check_session(session, {"alfalfa": alfalfa}, update, tmp_path, masked)


def masked(text: str) -> str:
    """Leave out what is measured on the wall."""
    return re.sub(r"no answer in [\d.]+ s", "no answer in … s", text)
