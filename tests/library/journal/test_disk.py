"""What was acknowledged outlives kills and full disks, and nothing else is acknowledged."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from pluto_fleet.journal import place
from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.store import Store
from tests.library.journal.appender import WHY, text
from tests.paths import ROOT


def appender(*arguments: object) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "tests.library.journal.appender", *map(str, arguments)],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT / "runtime")},
        stdout=subprocess.PIPE,
        text=True,
    )


def rows_of(path: Path, *, torn: bool = False) -> list[str]:
    """Return all rows but the header, and assert that nothing is damaged.

    Where rows had no room, what was not told to a reader may still lie there: then they are torn.
    """
    reader = Reader(path)
    rows = [row.text for row in reader.rows()][1:]
    reader.close()
    assert reader.damaged is None
    assert torn or reader.torn is None
    return rows


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 2 MiB of its own."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", disk], capture_output=True, check=False
    )
    if mounted.returncode != 0:
        pytest.skip("a file system can be mounted here by root alone")
    yield disk
    subprocess.run(["umount", disk], check=True)


def test_nothing_that_was_acknowledged_is_lost_by_a_kill(tmp_path: Path) -> None:
    path, durable = tmp_path / "J", 0
    for kill in range(6):
        process = appender(path)
        assert process.stdout is not None
        for _ in range(3 + 9 * kill):
            durable = int(process.stdout.readline())
        process.kill()
        said = process.communicate()[0].splitlines()
        durable = int(said[-1]) if said and said[-1].isdigit() else durable
        rows = rows_of(path)
        assert len(rows) >= durable
        assert rows == [text(number) for number in range(1, len(rows) + 1)]
    store = Store.open(path)
    assert store.epoch == 7
    store.close()


def full(process: subprocess.Popen[str], path: Path) -> list[str]:
    """Return what an appender said when its disk was full; assert what holds then."""
    lines = process.communicate()[0].splitlines()
    assert process.returncode == 0
    *numbers, why, words = lines
    durable = int(numbers[-1]) if numbers else 0
    rows = rows_of(path, torn=True)
    assert rows[:durable] == [text(number) for number in range(1, durable + 1)]
    written = len(rows) - (rows[-1:] == [WHY])
    assert rows[:written] == [text(number) for number in range(1, written + 1)]
    assert f"{path}: the journal cannot be written: " in why
    assert f"What was written before, {written} rows, is safe" in why
    assert not place.beside(path, ".reserve").exists()
    return [why, words]


def test_on_a_full_disk_nothing_is_acknowledged_and_the_last_words_still_fit(
    small_disk: Path,
) -> None:
    path = small_disk / "J"
    why, words = full(appender(path), path)
    assert "the disk is full" in why
    assert words == "last words: True"
    assert rows_of(path, torn=True)[-1] == WHY


def test_on_a_disk_that_is_almost_full_no_part_of_a_journal_is_made(small_disk: Path) -> None:
    filler = small_disk / "filler"
    for left in (0, 8_192, 100_000, 280_000, 310_000):
        facts = os.statvfs(small_disk)
        filler.write_bytes(b"x" * (facts.f_bavail * facts.f_frsize - left))
        with pytest.raises(JournalError, match=r"the journal cannot be (made|opened): the disk"):
            Store.create(small_disk / "J", {})
        assert os.listdir(small_disk) == ["filler"]
        filler.unlink()
    Store.create(small_disk / "J", {}).close()


def test_where_files_may_not_grow_nothing_is_acknowledged_either(tmp_path: Path) -> None:
    for room in (60_000, 300_000, 1_000_000):
        path = tmp_path / f"J{room}"
        why, words = full(appender(path, room), path)
        assert "the disk" in why
        assert words == "last words: True"


def test_a_journal_goes_on_once_there_is_room_again(tmp_path: Path) -> None:
    path = tmp_path / "J"
    full(appender(path, 200_000), path)
    before = len(rows_of(path, torn=True))
    store = Store.open(path)
    store.append(['["more"]'])
    store.close()
    assert len(rows_of(path)) == before + 1


def test_two_processes_never_write_one_journal(tmp_path: Path) -> None:
    path = tmp_path / "J"
    store = Store.create(path, {})
    said = appender(path).communicate()[0]
    assert said.startswith(f"{path}: process {os.getpid()} is writing this journal, and only one")
    store.close()


@pytest.fixture
def read_only(tmp_path: Path) -> Iterator[Path]:
    """A folder in which nothing can be written, with a journal whose app was killed."""
    folder = tmp_path / "folder"
    folder.mkdir()
    root = os.geteuid() == 0
    if root:
        mount = ["mount", "-t", "tmpfs", "tmpfs", str(folder)]
        if subprocess.run(mount, capture_output=True, check=False).returncode != 0:
            pytest.skip("root may write everywhere, and no file system can be mounted here")
    process = appender(folder / "J")
    assert process.stdout is not None
    process.stdout.readline()
    process.kill()
    process.communicate()
    (folder / "J-shm").unlink()
    if root:
        subprocess.run(["mount", "-o", "remount,ro", folder], check=True)
    else:
        folder.chmod(0o555)
    yield folder
    if root:
        subprocess.run(["umount", folder], check=True)
    else:
        folder.chmod(0o755)


def test_in_a_folder_that_may_only_be_read_a_journal_is_read_and_nothing_else(
    read_only: Path,
) -> None:
    assert rows_of(read_only / "J")
    with pytest.raises(
        JournalError, match=r"cannot be made: .*; name another place with --journal"
    ):
        Store.create(read_only / "another", {})
    with pytest.raises(JournalError, match="the journal cannot be opened"):
        Store.open(read_only / "J")
