"""The small parts of the command line: figures, JSON, the progress bar."""

from __future__ import annotations

import io
import json
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.cli.runs import RunFigures, summary
from pluto_fleet.report.sentences import line_of
from pluto_fleet.report.spread import spread
from pluto_fleet.report.terminal import Progress, table
from pluto_fleet.shared.alone.world import shares
from pluto_fleet.shared.domain.trace import dumped


def test_the_summary_counts_successes_and_times_only_those() -> None:
    """A mission that failed early is not a fast one."""
    runs = [
        RunFigures(seed=seed, success=seed != 2, makespan=float(10 * seed), attempts=seed, failed=0)
        for seed in range(1, 5)
    ]
    figures = summary(runs)
    assert (figures["runs"], figures["succeeded"], figures["success_rate"]) == (4, 3, 0.75)
    assert figures["failed_seeds"] == [2]
    makespan = figures["makespan_s"]
    assert isinstance(makespan, dict)
    assert (makespan["min"], makespan["median"], makespan["max"]) == (10.0, 30.0, 40.0)
    assert summary(runs[1:2])["makespan_s"] is None


@given(st.lists(st.floats(0, 1e6), min_size=1, max_size=30))
def test_a_spread_is_ordered(values: list[float]) -> None:
    """From the least over the percentiles to the most."""
    found = spread(values)
    assert found is not None
    ordered = [found[key] for key in ("min", "p5", "median", "p90", "p95", "max")]
    assert ordered == sorted(ordered)


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
        lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
        max_leaves=10,
    )
)
def test_any_plain_data_is_valid_json_of_three_decimals(data: object) -> None:
    """No infinity, no minus nought, no line break."""
    text = dumped(data)
    assert "\n" not in text

    def three(number: str) -> float:
        assert number != "-0.0"
        assert float(number) == round(float(number), 3)
        return float(number)

    def refuse(word: str) -> float:
        raise AssertionError(word)

    json.loads(text, parse_float=three, parse_constant=refuse)


def test_faults_are_read_with_or_without_blanks() -> None:
    """A percentage, or a share of 1."""
    assert shares("crash=10%, link = 5 %,action=0.01") == {
        "crash": 0.1,
        "link": 0.05,
        "action": 0.01,
    }


@pytest.mark.parametrize(
    ("event", "line"),
    [
        ({"event": "trip.launched", "trip": "A", "drone": "cf1", "attempt": 2},
         "     2.5 s  M: trip A launched, again (cf1)"),
        ({"event": "trip.failed", "trip": "A", "drone": "cf1", "reason": "why"},
         "     2.5 s  M: trip A failed (cf1): why"),
        ({"event": "mission.repeated", "round": 1}, "     2.5 s  M: round 2 begins"),
        ({"event": "mission.extended", "redo": ["A", "B"], "add": []},
         "     2.5 s  M: goes on with more trips (again: A, B)"),
        ({"event": "mission.ended", "status": "FAILED", "reason": "why"},
         "     2.5 s  M: FAILED: why"),
        ({"event": "trip.allocated"}, None),
    ],
)  # fmt: skip
def test_an_event_is_a_line(event: dict[str, object], line: str | None) -> None:
    """Or nothing, where it is of no interest to a person."""
    assert line_of({"t": 2.5, "mission": "M", **event}) == line


def test_the_bar_comes_only_after_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    """And goes without a trace; what the terminal has no room for is cut off."""
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "40")
    now, stream = [0.0], io.StringIO()
    bar = Progress(stream, clock=lambda: now[0])
    bar.update(0.1, "early")
    bar.clear()
    assert stream.getvalue() == ""
    now[0] = 1.5
    bar.update(0.5, "a half of all")
    bar.update(0.6, "too soon")
    now[0] = 2.0
    bar.update(1.5, "all")
    bar.clear()
    drawn = stream.getvalue().split("\r\x1b[2K")
    assert [line.strip() for line in drawn] == [
        "",
        "━" * 15 + " " * 16 + "a half o…",
        "━" * 30 + " all",
        "",
    ]


def test_without_a_terminal_a_line_comes_now_and_then() -> None:
    """One in ten seconds: there is no long silence, and no log is flooded."""
    now, said = [0.0], list[str]()
    progress = Progress(None, said.append, lambda: now[0])
    for second in range(35):
        now[0] = float(second)
        progress.update(0.5, f"{second} runs")
    progress.clear()
    assert said == ["10 runs", "20 runs", "30 runs"]


def test_a_table_lines_up() -> None:
    """Words to the left, numbers to the right, no blanks at the end, nothing unprintable."""
    assert list(table(("a", "n"), [("long", "1"), ("\x1b", "23")], right=(1,))) == [
        "a      n",
        "long   1",
        "\\x1b  23",
    ]


def test_at_a_terminal_a_table_is_no_wider(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its words wrap in their columns, its numbers stay whole, and its heads are bold."""
    monkeypatch.setenv("COLUMNS", "20")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    lines = list(table(("n", "why"), [("1000", "a reason of [several] words")], right=(0,)))
    assert lines[0].startswith("\x1b[1m")
    assert lines[1:] == ["1000  a reason of", "      [several]", "      words"]
