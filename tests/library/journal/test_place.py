"""A journal has a place even when none is named."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from pluto_fleet.journal import place
from pluto_fleet.journal.errors import JournalError

NOON = 1_800_000_000.0


@pytest.fixture(autouse=True)
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state"


def test_journals_of_an_app_lie_in_a_folder_of_its_own_that_no_other_user_reads(
    state: Path,
) -> None:
    path = place.new("alfalfa", NOON)
    assert path.parent == state / "pluto" / "alfalfa"
    assert path.name.startswith("2027-01-1")
    assert path.suffix == ".journal"
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700


def test_without_a_place_for_state_it_is_in_the_home_folder(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    for unset in ("", "not/absolute"):
        monkeypatch.setenv("XDG_STATE_HOME", unset)
        path = place.new("alfalfa", NOON)
        assert path.parent == tmp_path / ".local" / "state" / "pluto" / "alfalfa"


@pytest.mark.parametrize("suffix", ["", ".lock"])
def test_two_flights_of_one_second_have_two_journals(suffix: str) -> None:
    """Also where the first has only its lock as yet."""
    first = place.new("alfalfa", NOON)
    place.beside(first, suffix).touch()
    second = place.new("alfalfa", NOON)
    assert second != first
    second.touch()
    assert place.newest("alfalfa") in (first, second)


def test_the_newest_is_the_one_that_was_written_last() -> None:
    paths = []
    for hour in range(3):
        path = place.new("alfalfa", NOON + 3600 * hour)
        path.touch()
        os.utime(path, (NOON + hour, NOON + hour))
        paths.append(path)
    assert place.newest("alfalfa") == paths[2]
    log = place.beside(paths[0], "-wal")
    log.touch()
    os.utime(log, (NOON + 10, NOON + 10))
    assert place.newest("alfalfa") == paths[0]


def test_without_any_journal_one_must_be_named(state: Path) -> None:
    with pytest.raises(JournalError, match=f"alfalfa: there is no journal in {state}"):
        place.newest("alfalfa")


def test_without_a_home_the_message_says_how_to_name_a_place(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv("XDG_STATE_HOME")
    monkeypatch.setenv("HOME", "")
    with pytest.raises(JournalError, match=r"no home folder .* --journal"):
        place.new("alfalfa", NOON)


def test_where_no_folder_can_be_made_the_message_says_how_to_name_a_place(state: Path) -> None:
    state.write_text("a file is in the way", encoding="utf-8")
    with pytest.raises(JournalError, match=r"cannot be kept here: not a directory; .* --journal"):
        place.new("alfalfa", NOON)
