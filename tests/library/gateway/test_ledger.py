"""The ledger: with files damaged or lost and processes killed, nothing that was done is flown again."""

from __future__ import annotations

from pathlib import Path
from shutil import copyfile

import pytest

from pluto_fleet.gateway.ledger import Ledger
from pluto_fleet.jobs.reports import Entry, JobState
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Photo
from tests.library.gateway.flights import Field, Task
from tests.library.journal.damage import full_disk
from tests.library.simulation.flights import fly

PHOTO = Photo(position=(1.0, 2.0, 3.0), width=1.5, height=1.0, sees=("bloom",), sharpness=0.9)


def entry(id: str, state: JobState = JobState.DONE, value: object = None) -> Entry:
    return Entry(id=id, drone="cf1", state=state, boot=3, value=value)


def kept(path: Path) -> dict[str, JobState]:
    ledger = Ledger(path)
    known = {entry.id: entry.state for entry in ledger.entries()}
    ledger.close()
    return known


def test_what_was_written_is_there_for_the_next_process(tmp_path: Path) -> None:
    """The last word on each job counts; photos come back whole."""
    ledger = Ledger(tmp_path / "ledger")
    ledger.write(entry("a", JobState.BEGUN))
    ledger.write(entry("b"))
    ledger.write(entry("a", value=PHOTO))
    ledger.forget("b")
    ledger.close()
    assert list(Ledger(tmp_path / "ledger").entries()) == [entry("a", value=PHOTO)]


def test_what_is_not_synced_outlives_a_killed_process(tmp_path: Path) -> None:
    """Only a power failure takes it back."""
    path = tmp_path / "ledger"
    ledger = Ledger(path)
    ledger.write(entry("a"))
    ledger.write(entry("b"))
    ledger.forget("a")
    ledger.write_cut("cf1", True)
    killed = tmp_path / "killed"
    for end in ("", "-wal"):
        copyfile(f"{path}{end}", f"{killed}{end}")
    again = Ledger(killed)
    assert (list(again.entries()), again.cut) == ([entry("b")], ["cf1"])


@pytest.mark.parametrize("text", [b"no database", bytes(4096), b'{"id": "a"}\n' * 400])
def test_a_damaged_file_is_moved_aside_and_writing_goes_on(text: bytes, tmp_path: Path) -> None:
    """The ledger knows that something is missing."""
    path = tmp_path / "ledger"
    path.write_bytes(text)
    ledger = Ledger(path)
    assert not ledger.is_whole
    assert list(ledger.entries()) == []
    ledger.write(entry("a"))
    ledger.close()
    assert Path(f"{path}.damaged").read_bytes() == text
    again = Ledger(path)
    assert (list(again.entries()), again.is_whole) == ([entry("a")], True)


def test_a_page_that_was_damaged_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "ledger"
    ledger = Ledger(path)
    for number in range(200):
        ledger.write(entry(f"job {number}"))
    ledger.close()
    told = bytearray(path.read_bytes())
    told[4096:4200] = bytes(104)
    path.write_bytes(told)
    assert not Ledger(path).is_whole


@pytest.mark.parametrize(
    ("damaged", "epoch", "known", "begun"),
    [
        pytest.param(True, 2, [Task().id], 0, id="the ledger was damaged"),
        pytest.param(False, 2, [], 0, id="the ledger was lost"),
        pytest.param(False, 1, [], 1, id="a first life: it may remember another flight"),
    ],
)
def test_a_drone_that_remembers_what_the_ledger_does_not_have_is_believed(
    damaged: bool, epoch: int, known: list[str], begun: int
) -> None:
    """It is not done again, but in a first life, whose jobs may have the names of another flight's."""
    field, heard = Field(), list[object]()
    field.link(1).fly(Task(action="measure", item=None), heard.append)
    field.advance(50)
    field.gateway.crash()
    field.ledger.forget(Task().id)
    field.ledger.is_whole = not damaged
    field.another()
    link = field.link(epoch)
    assert [*fly(field.kernel, link.fleet_report()).jobs] == known
    link.fly(Task(action="measure", item=None), heard.append)
    field.advance(50)
    assert (len(heard), len(field.deeds)) == (2, 1 + begun)
    assert begun or heard[1] == heard[0]


def test_an_action_that_cannot_be_written_down_is_not_begun(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """On a full disk, the job fails and says why; the drone is well."""
    field, heard = Field(), list[object]()

    def full(_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(field.ledger, "write", full)
    field.link(1).fly(Task(), heard.append)
    field.advance(50)
    (error,) = heard
    assert isinstance(error, FlightFailed)
    assert error.failure is Failure.REFUSED
    assert "pick_item was not begun: it cannot be written down before" in str(error)
    assert (field.deeds, field.navigation.carrying("cf1")) == ([], None)


def test_a_full_disk_leaves_the_ledger_as_it_was(tmp_path: Path) -> None:
    """What cannot be written is refused, and when there is room, writing goes on."""
    path = tmp_path / "ledger"
    ledger = Ledger(path)
    ledger.write(entry("a"))
    with full_disk(Path(f"{path}-wal").stat().st_size), pytest.raises(OSError, match=r"full|error"):
        ledger.write(entry("b"))
    ledger.write(entry("c"))
    ledger.close()
    assert list(kept(path)) == ["a", "c"]
