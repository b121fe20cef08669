"""For all damage to the file: never a wrong event, never a traceback, and what is sound is read."""

from __future__ import annotations

import re
import sqlite3
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import pytest

from pluto_fleet.journal.database import VERSION
from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.store import Store
from tests.library.journal.damage import HEADER, ROWS, closed, holds, killed

PAGE, LOG_HEADER, FRAME = 4096, 32, 4096 + 24


@pytest.fixture(scope="module")
def at_rest(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return closed(tmp_path_factory.mktemp("closed"))


@pytest.fixture(scope="module")
def after_a_kill(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return killed(tmp_path_factory.mktemp("killed"))


@pytest.fixture
def quick() -> Iterator[Path]:
    """A folder in memory, where there is one: these journals need not outlive the power."""
    memory = Path("/dev/shm")
    with TemporaryDirectory(dir=memory if memory.is_dir() else None) as folder:
        yield Path(folder)


def flipped(content: bytes, place: int, bit: int) -> bytes:
    damaged = bytearray(content)
    damaged[place] ^= 1 << bit
    return bytes(damaged)


def places(length: int, first: int, size: int) -> Iterator[int]:
    """Yield, in every page, places in its head and some that are drawn."""
    chance = Random(length)
    for start in range(first, length, size):
        for place in (0, 3, 8, chance.randrange(size)):
            if start + place < length:
                yield start + place


def test_a_flipped_bit_in_any_page_shows_no_wrong_event(
    quick: Path, at_rest: dict[str, bytes]
) -> None:
    content, ends = at_rest["J"], set()
    chance = Random(1)
    for place in places(len(content), 0, PAGE):
        files = {"J": flipped(content, place, chance.randrange(8))}
        end, readable = holds(quick / "w", files)
        ends.add(end)
        # one page holds a row or two, or some dozens; all others are still read
        assert readable > len(ROWS) * 2 / 3
    assert ends == {"sound", "damaged", "refused"}


def test_a_flipped_bit_in_any_page_of_the_log_shows_no_wrong_event(
    quick: Path, after_a_kill: dict[str, bytes]
) -> None:
    log, ends = after_a_kill["J-wal"], set()
    chance = Random(2)
    for place in (*range(0, LOG_HEADER, 3), *places(len(log), LOG_HEADER, FRAME)):
        files = {**after_a_kill, "J-wal": flipped(log, place, chance.randrange(8))}
        ends.add(holds(quick / "w", files)[0])
    assert ends == {"torn", "refused"}


def test_a_journal_that_was_cut_anywhere_shows_no_wrong_event(
    quick: Path, at_rest: dict[str, bytes], after_a_kill: dict[str, bytes]
) -> None:
    content = at_rest["J"]
    for length in (*range(0, len(content), 3001), len(content) - 1):
        end, readable = holds(quick / "w", {"J": content[:length]})
        assert end in ("refused", "damaged")
        assert readable >= (length // PAGE - 9) // 2  # of every page that is left


def test_a_log_that_was_cut_anywhere_ends_with_a_whole_commit(
    quick: Path, after_a_kill: dict[str, bytes]
) -> None:
    log = after_a_kill["J-wal"]
    lengths = set()
    for length in (*range(0, len(log), 3001), len(log) - 1):
        folder = quick / "w"
        folder.mkdir(exist_ok=True)
        (folder / "J").write_bytes(after_a_kill["J"])
        (folder / "J-wal").write_bytes(log[:length])
        store = Store.open(folder / "J")
        found = [row.text for row in store.read().rows]
        assert found == ROWS[51 : 51 + len(found)]
        lengths.add(50 + len(found))
        store.close()
    assert lengths <= {100, 104, 108, 112, 116}
    assert len(lengths) >= 4


def test_a_last_row_that_is_not_sound_is_left_out_and_said(tmp_path: Path) -> None:
    path = tmp_path / "J"
    store = Store.create(path, HEADER)
    store.append(["[1]", "[2]", "[3]"])
    store.close()
    path.write_bytes(path.read_bytes().replace(b"[3]", b"[4]"))
    store = Store.open(path)
    assert [row.text for row in store.read().rows] == ["[1]", "[2]"]
    assert store.torn is not None
    assert "row 3, the last one" in store.torn
    store.append(["[5]"])
    store.close()
    store = Store.open(path)
    assert (store.torn, [row.text for row in store.read().rows]) == (None, ["[1]", "[2]", "[5]"])
    store.close()


def test_rows_that_vanish_from_the_end_are_missed(tmp_path: Path) -> None:
    path = tmp_path / "J"
    store = Store.create(path, HEADER)
    store.append(["[1]", "[2]", "[3]"])
    store.close()
    with closing(sqlite3.connect(path)) as database:
        database.execute("DELETE FROM journal WHERE seq > 1")
        database.commit()
    store = Store.open(path)
    read = store.read()
    assert [row.text for row in read.rows] == ["[1]"]
    assert read.damaged == "rows 2 to 3 of 3 cannot be found; 1 row before it can be read"
    store.close()


def test_without_its_tip_no_row_is_lost_and_its_epoch_grows_all_the_same(tmp_path: Path) -> None:
    path = tmp_path / "J"
    store = Store.create(path, HEADER)
    store.append(["[1]", "[2]"])
    store.close()
    with closing(sqlite3.connect(path)) as database:
        database.execute("UPDATE tip SET epoch = 0")
        database.commit()
    again = Store.open(path)
    assert [row.text for row in again.read().rows] == ["[1]", "[2]"]
    assert again.epoch > store.epoch
    again.close()


def test_a_damaged_snapshot_is_replaced_by_the_one_before_and_then_by_all_rows(
    tmp_path: Path,
) -> None:
    path = tmp_path / "J"
    store = Store.create(path, HEADER)
    for number in range(1, 4):
        store.append([f"[{number}]"])
        store.snapshot(f"state {number}")
    store.close()
    for number, then, rows in ((3, "state 2", 1), (2, None, 3)):
        path.write_bytes(path.read_bytes().replace(b"state %d" % number, b"state x"))
        store = Store.open(path)
        read = store.read()
        assert (read.snapshot, len(list(read.rows)), read.damaged) == (then, rows, None)
        assert f"the snapshot of row {number} is damaged" in " ".join(read.warnings)
        store.close()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "the file is empty"),
        (b"[[mission]]\n", "it is no journal of an app"),
        (bytes(Random(3).randbytes(9000)), "it is no journal of an app"),
    ],
)
def test_another_file_is_refused_and_left_as_it_is(
    tmp_path: Path, content: bytes, said: str
) -> None:
    path = tmp_path / "J"
    path.write_bytes(content)
    for opens in (Store.open, Reader):
        with pytest.raises(JournalError, match=said):
            opens(path)
    with pytest.raises(JournalError, match="there is a journal already"):
        Store.create(path, HEADER)
    assert [(file.name, file.read_bytes()) for file in tmp_path.iterdir()] == [("J", content)]


@pytest.mark.parametrize(
    ("statement", "why"),
    [
        ("CREATE TABLE journal (seq INTEGER)", "it is no journal of an app"),
        (
            f"PRAGMA user_version = {VERSION + 1}",
            f"its format is {VERSION + 1}, and pluto-fleet .* reads {VERSION}: install",
        ),
        ("DROP TABLE snapshot", "its tables are not those of a journal"),
    ],
)
def test_a_database_that_is_another_is_refused_and_left_as_it_is(
    tmp_path: Path, statement: str, why: str
) -> None:
    path = tmp_path / "J"
    if "CREATE" not in statement:
        Store.create(path, HEADER).close()
    with closing(sqlite3.connect(path)) as database:
        database.execute(statement)
        database.commit()
    content = path.read_bytes()
    with pytest.raises(JournalError, match=why):
        Store.open(path)
    with suppress(JournalError):  # what is damaged is read as far as it goes
        reader = Reader(path)
        assert re.search(why, str(reader.damaged))
        reader.close()
    assert path.read_bytes() == content


@pytest.mark.parametrize("opens", [Store.open, Reader])
def test_what_is_no_file_is_refused(tmp_path: Path, opens: type[Reader]) -> None:
    with pytest.raises(JournalError, match="it is a folder"):
        opens(tmp_path)
    with pytest.raises(JournalError, match="there is no such journal"):
        opens(tmp_path / "none")
    with pytest.raises(JournalError, match="it is no file"):
        opens(Path("/dev/null"))
    with pytest.raises(JournalError, match="cannot be opened"):
        opens(tmp_path / "a\0b")
