"""For all damage to the file: never a traceback, and a sentence that says how to go on."""

from __future__ import annotations

import re
import shutil
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
from tests.library.journal.damage import HEADER, TEXTS, closed, entry, killed, written

PAGE = 4096


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


def taken(folder: Path, files: dict[str, bytes]) -> str:
    """Say how a journal of these files is taken: it opens, or a sentence says why not."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name, content in files.items():
        (folder / name).write_bytes(content)
    path = folder / "J"
    try:
        with closing(Reader(path)) as reader:
            for instant in reader.instants():
                with suppress(ValueError):
                    instant.events  # noqa: B018 # what is damaged is no list of events
            assert reader.damaged is None or "\n" not in reader.damaged
    except JournalError as error:
        assert str(error).startswith(str(path)), error
    try:
        with closing(Store.open(path)) as store:
            store.standing()
    except JournalError as error:
        assert str(error).startswith(str(path)), error
        return "refused"
    return "opened"


def test_a_flipped_bit_in_any_page_is_refused_in_a_sentence_or_does_no_harm(
    quick: Path, at_rest: dict[str, bytes]
) -> None:
    content, ends = at_rest["J"], set()
    chance = Random(1)
    for place in places(len(content), 0, PAGE):
        files = {"J": flipped(content, place, chance.randrange(8))}
        ends.add(taken(quick / "w", files))
    assert ends == {"opened", "refused"}


def test_a_journal_that_was_cut_anywhere_is_refused(quick: Path, at_rest: dict[str, bytes]) -> None:
    content = at_rest["J"]
    for length in (*range(0, len(content), 9001), len(content) - 1):
        assert taken(quick / "w", {"J": content[:length]}) == "refused"


def test_a_log_that_was_cut_anywhere_ends_with_a_whole_commit(
    quick: Path, after_a_kill: dict[str, bytes]
) -> None:
    """Events and rows of an instant are there together, or neither is."""
    log = after_a_kill["J-wal"]
    lengths = set()
    for length in (*range(0, len(log), 3001), len(log) - 1):
        folder = quick / "w"
        folder.mkdir(exist_ok=True)
        (folder / "J").write_bytes(after_a_kill["J"])
        (folder / "J-wal").write_bytes(log[:length])
        with closing(Store.open(folder / "J")) as store:
            last = store.seq
            trips = [row["trips"] for row in store.standing().drones.values()]
        with closing(Reader(folder / "J")) as reader:
            assert [instant.text for instant in reader.instants()] == TEXTS[: last + 1]
        assert max(trips) == last
        lengths.add(last)
    assert lengths <= {100, 104, 108, 112, 116}
    assert len(lengths) >= 4


def test_of_a_damaged_journal_it_is_said_which_copy_is_whole(tmp_path: Path) -> None:
    """In its place, the flight goes on from there; a copy that is damaged itself is named by nobody."""
    path = tmp_path / "J"
    store = written(tmp_path)
    store.copy()
    store.append([entry(121)])
    store.copy()
    store.close()
    path.write_bytes(b"x" * 50 + path.read_bytes()[50:])
    for ending, seq in ((".copy", 121), (".copy-before", 120)):
        copied = path.with_name(f"J{ending}")
        with pytest.raises(JournalError, match=f"is whole: to go on from that, put {copied} in"):
            Store.open(path)
        content = copied.read_bytes()
        with closing(Store.open(copied)) as again:
            assert again.seq == seq
        copied.write_bytes(content[: len(content) // 2])
    with pytest.raises(JournalError, match="there is no whole copy beside it"):
        Store.open(path)


def test_entries_that_vanish_from_the_middle_are_missed(tmp_path: Path) -> None:
    path = tmp_path / "J"
    written(tmp_path).close()
    with closing(sqlite3.connect(path)) as database:
        database.execute("DELETE FROM event WHERE seq = 50")
        database.commit()
    with closing(Reader(path)) as reader:
        assert len([*reader.instants()]) == 50
        assert reader.damaged == "entry 50 cannot be found"


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
        ("CREATE TABLE event (seq INTEGER)", "it is no journal of an app"),
        (
            f"PRAGMA user_version = {VERSION + 1}",
            f"its format is {VERSION + 1}, and pluto-fleet .* reads {VERSION}: install",
        ),
        ("DROP TABLE result", "its tables are not those of a journal"),
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
