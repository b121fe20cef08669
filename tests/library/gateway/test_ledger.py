"""The ledger: with rows torn or lost and processes killed, nothing that was done is flown again."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from pluto_fleet.gateway.ledger import FileLedger
from pluto_fleet.jobs.reports import Entry, JobState
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Photo
from tests.library.gateway.flights import Field, Task
from tests.library.simulation.flights import fly

PHOTO = Photo(position=(1.0, 2.0, 3.0), width=1.5, height=1.0, sees=("bloom",), sharpness=0.9)


def entry(id: str, state: JobState = JobState.DONE, value: object = None) -> Entry:
    return Entry(id=id, drone="cf1", state=state, boot=3, value=value)


def kept(path: Path) -> dict[str, JobState]:
    ledger = FileLedger(path)
    ledger.close()
    return {entry.id: entry.state for entry in ledger.entries()}


def test_what_was_written_is_there_for_the_next_process(tmp_path: Path) -> None:
    """The last word on each job counts; photos come back whole."""
    ledger = FileLedger(tmp_path / "ledger")
    ledger.write(entry("a", JobState.BEGUN))
    ledger.write(entry("b"))
    ledger.write(entry("a", value=PHOTO))
    ledger.forget("b")
    ledger.close()
    assert list(FileLedger(tmp_path / "ledger").entries()) == [entry("a", value=PHOTO)]


def test_a_line_that_was_never_finished_is_no_line(tmp_path: Path) -> None:
    """Cut anywhere, it is as if the last change had not been made; and writing goes on."""
    path = tmp_path / "ledger"
    ledger = FileLedger(path)
    ledger.write(entry("a"))
    whole = path.stat().st_size
    ledger.write(entry("b", JobState.BEGUN))
    ledger.close()
    told = path.read_bytes()
    for end in range(whole, len(told)):
        path.write_bytes(told[:end])
        ledger = FileLedger(path)
        assert [entry.id for entry in ledger.entries()] == ["a"]
        assert ledger.is_whole
        ledger.write(entry("c"))
        ledger.close()
        assert list(kept(path)) == ["a", "c"]


def test_a_damaged_line_is_not_believed(tmp_path: Path) -> None:
    """For every byte; the ledger knows that something is missing."""
    path = tmp_path / "ledger"
    ledger = FileLedger(path)
    for id in "abc":
        ledger.write(entry(id))
    ledger.close()
    told = path.read_bytes()
    for place in range(len(told)):
        path.write_bytes(told[:place] + bytes([told[place] ^ 4]) + told[place + 1 :])
        damaged = FileLedger(path)
        damaged.close()
        assert all(known == entry(known.id) for known in damaged.entries())
        assert not damaged.is_whole or len(list(damaged.entries())) == 2  # its last end of line


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


def test_the_file_does_not_grow_while_its_gateway_runs(tmp_path: Path) -> None:
    """However many trips are flown; what is still to be known is there all the time."""
    path = tmp_path / "ledger"
    ledger = FileLedger(path)
    ledger.write(entry("stays", JobState.BEGUN))
    ledger.write_cut("cf9", True)
    for number in range(3000):
        ledger.write_cut("cf1", number % 2 == 0)
        ledger.forget(str(number))
    ledger.write(entry("last"))
    assert path.stat().st_size < 150_000
    ledger.close()
    again = FileLedger(path)
    assert list(again.entries()) == [entry("stays", JobState.BEGUN), entry("last")]
    assert list(again.cut) == ["cf9"]
    again.close()


class PowerCut(BaseException):
    """The process is gone in the middle of something."""


@pytest.mark.parametrize("at", range(8))
def test_a_death_at_any_write_of_the_new_file_loses_nothing(
    at: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Cut off at each of its calls to the system, before it and after it."""
    path, calls = tmp_path / "ledger", iter(range(100))
    ledger = FileLedger(path)
    ledger.write(entry("stays", value=PHOTO))
    ledger.write_cut("cf2", True)
    for number in range(2000):
        ledger.forget(str(number))

    def dying(real: Callable[..., object]) -> Callable[..., object]:
        def call(*given: object, **named: object) -> object:
            if next(calls) == at:
                raise PowerCut
            result = real(*given, **named)
            if next(calls) == at:
                raise PowerCut
            return result

        return call

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_bytes", dying(Path.write_bytes))
        patch.setattr(Path, "replace", dying(Path.replace))
        patch.setattr(os, "fsync", dying(os.fsync))
        with pytest.raises(PowerCut):
            for number in range(20):
                ledger.forget(str(number))
    again = FileLedger(path)
    assert (list(again.entries()), list(again.cut)) == ([entry("stays", value=PHOTO)], ["cf2"])
    assert again.is_whole
    again.close()


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
    """Half a line is taken out again, and when there is room, writing goes on."""
    path = tmp_path / "ledger"
    ledger = FileLedger(path)
    ledger.write(entry("a"))
    before = path.read_bytes()
    real = os.write
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "write", lambda file, text: real(file, text[:10]))
        with pytest.raises(OSError, match="no space"):
            ledger.write(entry("b"))
        ledger.forget("a")
    assert path.read_bytes() == before
    ledger.write(entry("c"))
    ledger.close()
    assert list(kept(path)) == ["a", "c"]
