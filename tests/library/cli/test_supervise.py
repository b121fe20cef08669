"""`--supervise` starts the app again when it crashes, and lets it end when it means to."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from pluto_fleet.cli.supervise import GIVES_UP_AFTER, Supervised, supervise

pytestmark = pytest.mark.process
LIVES = """
import os, signal, sys
place, ends = sys.argv[1:3]
with open(place, "a") as file:
    file.write(sys.argv[3] + "\\n")
with open(place) as file:
    life = len(file.readlines()) - 1
end = ends.split(",")[min(life, len(ends.split(",")) - 1)]
if end.startswith("-"):
    os.kill(os.getpid(), -int(end))
elif end == "waits":
    os.kill(os.getppid(), signal.SIGTERM)
    signal.sigwait([signal.SIGTERM])
    sys.exit(143)
elif end == "refuses":
    os.write(int(os.environ["PLUTO_REFUSES"]), b"!")
    sys.exit(2)
else:
    os._exit(int(end))
"""
"""A process that ends a different way each time, and writes down how it was called."""


Lived = Callable[..., tuple[int, list[str]]]


@pytest.fixture
def lived(tmp_path: Path) -> Lived:
    """Supervise a process that ends in these ways; give the exit code and how it was called."""
    log = tmp_path / "log"

    def run(
        ends: str,
        finished: Callable[[], int] = lambda: 0,
        over: Callable[[int], bool] = lambda _: True,
    ) -> tuple[int, list[str]]:
        words = [sys.executable, "-S", "-c", LIVES, str(log), ends]
        code = supervise(
            Supervised(
                name="app",
                first=[*words, "fly"],
                again=lambda: [*words, "resume"],
                finished=finished,
                over=over,
                how_to_go_on="to go on: app resume J",
                pauses=(0.0,),
            )
        )
        return code, log.read_text().split()

    return run


@pytest.mark.long
@pytest.mark.parametrize("code", [0, 1, 4, 129, 143])
def test_an_app_that_meant_to_end_is_not_started_again(code: int, lived: Lived) -> None:
    assert lived(str(code)) == (code, ["fly"])


@pytest.mark.parametrize("end", ["-9", pytest.param("70", marks=pytest.mark.long)])
def test_an_app_that_crashed_goes_on(
    end: str, lived: Lived, capfd: pytest.CaptureFixture[str]
) -> None:
    """By a signal, or by a mistake in it; and one is told."""
    assert lived(f"{end},{end},1") == (1, ["fly", "resume", "resume"])
    assert capfd.readouterr().err.count("it is started again") == 2


@pytest.mark.long
@pytest.mark.parametrize("code", [0, 1, 2, 4, 129, 130, 143])
def test_an_exit_code_counts_only_if_the_flight_has_ended(code: int, lived: Lived) -> None:
    """A hook can end the process with any: what has ended is in the journal."""
    over = iter([False, True])
    assert lived(f"{code},0", over=lambda _: next(over) if code != 2 else True) == (
        0,
        ["fly", "resume"],
    )


@pytest.mark.long
def test_an_app_that_refuses_to_go_on_is_not_asked_again(lived: Lived) -> None:
    """Its journal cannot say so: it may be what cannot be written."""
    assert lived("refuses", over=lambda _: False) == (2, ["fly"])


@pytest.mark.long
def test_an_app_that_crashes_again_and_again_stays_down(
    lived: Lived, capfd: pytest.CaptureFixture[str]
) -> None:
    """And one is told how to go on."""
    code, calls = lived("-9")
    assert (code, len(calls)) == (70, GIVES_UP_AFTER)
    said = capfd.readouterr().err.splitlines()
    assert said[-2:] == [
        f"app: the app was killed (SIGKILL); that was {GIVES_UP_AFTER} times in a row"
        + " with nothing finished, so it stays down",
        "to go on: app resume J",
    ]


@pytest.mark.long
def test_who_finishes_something_between_crashes_is_started_again_for_ever(lived: Lived) -> None:
    done = iter(range(100))
    crashes = ["-9"] * (GIVES_UP_AFTER + 1)
    code, calls = lived(",".join([*crashes, "0"]), lambda: next(done))
    assert (code, len(calls)) == (0, len(crashes) + 1)


@pytest.mark.long
def test_stopping_the_supervisor_stops_the_app(lived: Lived) -> None:
    """It is told by the same signal, and what it ends with is the end of all."""
    assert lived("waits") == (143, ["fly"])


@pytest.mark.long
def test_nothing_is_started_again_after_a_stop(
    lived: Lived, capfd: pytest.CaptureFixture[str]
) -> None:
    """Not even what crashes in that moment."""

    asked = iter([False, True])  # before the first life, and after it

    def finished() -> int:
        if next(asked):
            signal.raise_signal(signal.SIGTERM)
        return 0

    assert lived("-9", finished) == (143, ["fly"])
    assert "to go on: app resume J" in capfd.readouterr().err
