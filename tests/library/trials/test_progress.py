"""What those see who wait for `plutoc test`."""

from __future__ import annotations

from io import StringIO

import pytest

from pluto_fleet.report.progress import LINE_EVERY, Progress
from pluto_fleet.trials import command, explore
from tests.trials.examples import example


class Clock:
    """Time that passes when the test says so."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def test_without_a_terminal_a_line_comes_now_and_then() -> None:
    """One in ten seconds, with how far it is: there is no long silence, and no log is flooded."""
    clock, said = Clock(), list[str]()
    progress = Progress(StringIO(), clock, shown=False, say=said.append)
    for second in range(35):
        clock.now = float(second)
        progress.update(0.5, f"{second} runs")
    progress.clear()
    assert LINE_EVERY == 10.0
    assert said == ["10 runs", "20 runs", "30 runs"]


def test_the_bar_fills_as_runs_are_done(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the first seeds there are hundreds of runs each: it is neither full at once nor empty for long."""
    shares: list[float] = []

    class Waiting:
        def update(self, share: float, _: str) -> None:
            shares.append(share)

        def clear(self) -> None:
            pass

    monkeypatch.setattr(command, "trial_progress", lambda *, lines: Waiting())
    monkeypatch.setattr(explore, "MOST_ROWS", 4)
    assert command.test(example("drugs_distribution"), ["--seeds", "2", "--json"]) == 0
    assert len(shares) > 50
    assert shares[0] == 0
    assert 0.4 < shares[len(shares) // 2] < 0.6
    assert 0.9 < shares[-1] < 1.1
