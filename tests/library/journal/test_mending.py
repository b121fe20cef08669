"""A damaged journal is mended: of all rows up to the first that is gone, and never of other ones."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.cli import main
from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.mending import mend
from pluto_fleet.journal.salvage import salvage
from pluto_fleet.journal.store import Store
from tests.library.files.an_app import APP
from tests.library.journal.damage import HEADER, ROWS, closed, killed

PAGE = 4096


def texts(path: Path) -> list[str]:
    store = Store.open(path)
    read = store.read()
    rows = [row.text for row in read.rows]
    assert read.damaged is None
    assert read.snapshot is None
    store.close()
    return rows


def test_where_every_row_can_be_found_the_mended_journal_has_them_all(tmp_path: Path) -> None:
    files = killed(tmp_path)
    path = tmp_path / "J"
    damaged = bytearray(files["J-wal"])
    damaged[40] ^= 1  # SQLite then forgets the whole log
    path.write_bytes(files["J"])
    (tmp_path / "J-wal").write_bytes(damaged)
    with pytest.raises(JournalError, match="the journal is damaged"):
        Store.open(path)
    done = mend(path)
    assert done is not None
    assert (done.rows, done.lost) == (len(ROWS) - 1, 0)
    assert texts(path) == ROWS[1:]
    assert done.kept.read_bytes() == files["J"]
    assert (tmp_path / "J.damaged-wal").read_bytes() == bytes(damaged)


def test_rows_after_a_gap_are_left_out_and_counted(tmp_path: Path) -> None:
    path = tmp_path / "J"
    path.write_bytes(closed(tmp_path)["J"].replace(b'"t": 70.0', b'"t": 71.0'))
    epoch = 3
    done = mend(path)
    assert done is not None
    assert (done.rows, done.lost) == (69, 50)
    assert texts(path) == ROWS[1:70]
    store = Store.open(path)
    assert store.epoch > epoch
    store.append(["[]"])
    store.close()


@pytest.mark.parametrize("newer_is_in_the_log", [True, False])
def test_of_two_rows_of_one_number_the_later_epoch_counts(
    tmp_path: Path, newer_is_in_the_log: bool
) -> None:
    """One was torn off by a crash, and another was written in its place: wherever each is found."""
    files = []
    for lives in (1, 2):
        path = tmp_path / f"{lives}"
        store = Store.create(path, HEADER)
        for _ in range(1, lives):
            store.close()
            store = Store.open(path)
        store.append([f'["life {lives}"]'])
        store.close()
        files.append(path.read_bytes())
    older, newer = files
    content, logged = (older, newer) if newer_is_in_the_log else (newer, older)
    path = tmp_path / "J"
    path.write_bytes(content)
    (tmp_path / "J-wal").write_bytes(log_of(logged))
    assert [(row.seq, row.text) for row in salvage(path, 0)] == [(1, '["life 2"]')]


def log_of(content: bytes) -> bytes:
    """Return a write-ahead log with all pages of a journal."""
    starts = range(0, len(content), PAGE)
    pages = [
        (at // PAGE + 1).to_bytes(4, "big") + bytes(20) + content[at : at + PAGE] for at in starts
    ]
    return bytes(32) + b"".join(pages)


def test_a_journal_that_is_damaged_once_more_is_kept_once_more(tmp_path: Path) -> None:
    path = tmp_path / "J"
    closed(tmp_path)
    for last, name in ((70, "J.damaged"), (40, "J.damaged-2")):
        damaged = path.read_bytes().replace(b'"t": %d.0' % last, b'"t": 99.0')
        path.write_bytes(damaged)
        done = mend(path)
        assert done is not None
        assert (done.rows, done.kept.name, done.kept.read_bytes()) == (last - 1, name, damaged)


def test_a_sound_journal_is_left_as_it_is(tmp_path: Path) -> None:
    content = closed(tmp_path)["J"]
    assert mend(tmp_path / "J") is None
    assert (tmp_path / "J").read_bytes() == content


def test_what_was_broken_off_between_two_names_is_finished(tmp_path: Path) -> None:
    path = tmp_path / "J"
    closed(tmp_path)
    path.rename(tmp_path / "J.damaged")
    done = mend(path)
    assert done is not None
    assert (done.rows, done.lost) == (len(ROWS) - 1, 0)
    assert texts(path) == ROWS[1:]


def test_without_a_header_it_stays_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "J"
    content = closed(tmp_path)["J"].replace(b"alfalfa", b"alfalfx")
    path.write_bytes(content)
    with pytest.raises(JournalError, match="cannot be mended: its first row"):
        mend(path)
    assert path.read_bytes() == content


def test_what_is_being_written_is_not_mended(tmp_path: Path) -> None:
    store = Store.create(tmp_path / "J", HEADER)
    with pytest.raises(JournalError, match="is writing this journal"):
        mend(tmp_path / "J")
    store.close()


def test_the_command_says_what_it_did(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "J"
    path.write_bytes(closed(tmp_path)["J"].replace(b'"t": 70.0', b'"t": 71.0'))
    assert main(APP, ["journal", str(path), "--mend"]) == 0
    assert main(APP, ["journal", str(path), "--mend"]) == 0
    first, second = capsys.readouterr().out.splitlines()
    assert first == (
        f"{path}: mended: 69 rows are there again; 50 rows after a gap are left out, and resume asks"
        f" the drones what they did since; the damaged journal is kept as {path}.damaged"
    )
    assert second == f"{path}: nothing is damaged"
