"""What those see who wait for `plutoc test`."""

from __future__ import annotations

from io import StringIO

import pytest

from pluto_fleet.cli.progress import Progress
from pluto_fleet.trials import command
from pluto_fleet.trials.patience import EVERY, Patience
from tests.testing.examples import example


class Clock:
    """Time that passes when the test says so."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def test_without_a_terminal_a_line_comes_now_and_then() -> None:
    """One in ten seconds, with how far it is: there is no long silence, and no log is flooded."""
    clock, said = Clock(), list[str]()
    patience = Patience(Progress(StringIO(), clock, shown=False), clock, said.append)
    for second in range(35):
        clock.now = float(second)
        patience.tell(0.5, f"{second} runs")
    patience.over()
    assert EVERY == 10.0
    assert said == ["plutoc test: 10 runs", "plutoc test: 20 runs", "plutoc test: 30 runs"]


def test_at_a_terminal_a_bar_is_drawn_and_taken_away() -> None:
    """With the same words; what is found stands alone."""
    clock, terminal = Clock(), StringIO()
    patience = Patience(Progress(terminal, clock, shown=True), clock, None)
    clock.now = 2.0
    patience.tell(0.5, "12 runs")
    assert terminal.getvalue().endswith("] 12 runs")
    patience.over()
    assert terminal.getvalue().endswith(" \r")


@pytest.mark.parametrize("seeds", [1, 20])
def test_the_bar_fills_as_runs_are_done(seeds: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the first seeds there are hundreds of runs each: it is neither full at once nor empty for long."""
    shares: list[float] = []

    class Waiting:
        def tell(self, share: float, _: str) -> None:
            shares.append(share)

        def over(self) -> None:
            pass

    monkeypatch.setattr(command, "patience", lambda *, lines: Waiting())
    assert command.test(example("drugs_distribution"), ["--seeds", str(seeds), "--json"]) == 0
    assert len(shares) > 100
    assert shares[0] == 0
    assert 0.4 < shares[len(shares) // 2] < 0.6
    assert 0.9 < shares[-1] < 1.1
