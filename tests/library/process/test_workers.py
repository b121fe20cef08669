"""Work on all cores: in order, whole or not at all, and nothing is left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable

import pytest

from pluto_fleet.process.workers import WorkerDied, in_workers

pytestmark = pytest.mark.process


def squared(number: int) -> int:
    print(f"{number} squared")
    if number == 3:
        print("three!", file=sys.stderr)
    return number * number


@pytest.mark.usefixtures("no_worker_left")
@pytest.mark.parametrize("jobs", [7, pytest.param(1, marks=pytest.mark.long)])
def test_results_and_prints_come_in_order(jobs: int, capsys: pytest.CaptureFixture[str]) -> None:
    """However many work at once."""
    assert list(in_workers(squared, range(50), jobs)) == [number**2 for number in range(50)]
    out, err = capsys.readouterr()
    assert out.splitlines() == [f"{number} squared" for number in range(50)]
    assert err == "three!\n"


def fails(number: int) -> int:
    if number >= 20:
        raise LookupError(number)
    return number


@pytest.mark.long
@pytest.mark.usefixtures("no_worker_left")
@pytest.mark.parametrize("jobs", [1, 4])
def test_an_error_comes_in_its_turn(jobs: int) -> None:
    """After all that was done before it, as if there were no workers."""
    work = in_workers(fails, range(40), jobs)
    assert [next(work) for _ in range(20)] == list(range(20))
    with pytest.raises(LookupError, match="20") as raised:
        next(work)
    assert "in fails" in str(raised.value.__cause__)


def dies(how: Callable[[], object]) -> Callable[[int], int]:
    def work(number: int) -> int:
        if number == 4:
            how()
        return number

    return work


@pytest.mark.usefixtures("no_worker_left")
def test_a_worker_that_dies_is_told_with_its_task() -> None:
    """And the others are ended."""
    with pytest.raises(WorkerDied) as died:
        list(in_workers(dies(lambda: os.kill(os.getpid(), signal.SIGKILL)), range(12), 2))
    assert (died.value.place, died.value.how) == (4, "was killed by SIGKILL")


ENDED = """
import os, signal, sys
from pluto_fleet.process.workers import in_workers

def work(number):
    os.write(1, f"{os.getpid()}\\n".encode())
    signal.pause()

list(in_workers(work, [1, 2], 2))
"""


@pytest.mark.long
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_workers_end_with_who_is_told_to_end(number: signal.Signals) -> None:
    """By `kill`, or as the terminal closes."""
    path = os.pathsep.join(sys.path)
    with subprocess.Popen(
        [sys.executable, "-c", ENDED],
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": path},
    ) as process:
        assert process.stdout is not None
        workers = [int(process.stdout.readline()) for _ in range(2)]
        process.send_signal(number)
        assert process.wait() == -number
        assert process.stdout.read() == b""  # no worker has it open any more
    for worker in workers:
        with pytest.raises(ProcessLookupError):
            os.kill(worker, 0)
