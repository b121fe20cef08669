"""A journal in memory behaves as one on disk, and loses what was not committed."""

from __future__ import annotations

import pytest

from pluto_fleet.journal.errors import JournalError
from tests.library.journal.memory import Memory


def texts(memory: Memory) -> list[str]:
    return [row.text for row in memory.read().rows]


def test_a_crash_takes_what_was_added_after_the_last_commit() -> None:
    memory = Memory({"event": "journal.begun"})
    assert [memory.add("[1]"), memory.add("[2]")] == [1, 2]
    assert memory.commit() == 2
    memory.add("[3]")
    memory.reopen()
    assert (texts(memory), memory.epoch, memory.add("[4]")) == (["[1]", "[2]"], 2, 3)


def test_only_what_follows_the_newest_snapshot_is_read() -> None:
    memory = Memory({})
    memory.append(["[1]", "[2]"])
    memory.snapshot("two")
    memory.append(["[3]"])
    read = memory.read()
    assert (read.snapshot, read.after, [row.seq for row in read.rows]) == ("two", 2, [3])


def test_on_a_full_disk_a_commit_is_taken_whole_or_not_at_all() -> None:
    memory = Memory({})
    memory.room = 2
    memory.append(["[1]"])
    for number in (2, 3):
        memory.add(f"[{number}]")
    with pytest.raises(JournalError, match="the disk is full"):
        memory.commit()
    with pytest.raises(JournalError):
        memory.append(["[4]"])
    assert texts(memory) == ["[1]"]
    memory.last_words('["why"]')
    memory.room = None
    memory.reopen()
    memory.append(["[5]"])
    assert texts(memory) == ["[1]", '["why"]', "[5]"]
