"""The benchmark of the flow: what it says follows from what it measures. No time is asserted."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest

import instructions
from contenders.process import Said
from contenders.work import Done, Work, expected
from measuring.cases import SMALL, cases
from measuring.chart import Bar, Group, chart
from measuring.figures import FIGURES, figures
from measuring.page import picture, rewritten
from measuring.rounds import Measured, Spread
from tests.kit.command import Ran, python
from tests.paths import ROOT

DOCS = ROOT / "docs"


def script(*words: str) -> Ran:
    """Run a script of benchmarks/."""
    return python(*words, cwd=ROOT / "benchmarks")


SCRIPTS = sorted(path.name for path in (ROOT / "benchmarks").glob("*.py"))


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize("name", SCRIPTS)
def test_every_script_says_what_it_is_for_and_does_nothing_else(name: str) -> None:
    """And refuses what it does not know."""
    asked, wrong = script(name, "--help"), script(name, "--no-such-thing")
    assert (asked.code, asked.err) == (0, "")
    assert "show this help message" in asked.out
    assert (wrong.code, wrong.out) == (2, "")


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize(
    ("name", "arguments", "told"),
    [
        ("flow.py", ["--rounds", "0"], "argument --rounds: 0 is less than 1"),
        ("flow.py", ["--only", "ours_fre"], "there is no case ours_fre, only ideal_contended,"),
        ("compile.py", ["--sizes", "0", "10"], "argument --sizes: 0 is less than 1"),
        ("choosing.py", ["--shares", "10x0"], "argument --shares: 0 is less than 1"),
    ],
)
def test_what_cannot_be_measured_is_refused(name: str, arguments: list[str], told: str) -> None:
    """At once, and not by a traceback in the end."""
    done = script(name, *arguments)
    assert done.code == 2
    assert told in done.err


def said(flights: int, *cpu: float) -> Said:
    """Return what a contender might print."""
    return Said(
        flights=flights, cpu=[*cpu], wall=[*cpu], on_the_ground=[], threads=1, peak_mib=20.0
    )


def measured(flights: int, *cpu: float) -> Measured:
    """Return what was measured of such a contender."""
    case = Measured()
    case.add(said(flights, *cpu))
    return case


@pytest.mark.long
@pytest.mark.process
def test_every_contender_that_is_there_does_the_work_and_is_told(tmp_path: Path) -> None:
    """Each checks what came of its flights; those that are not installed are named."""
    done = script("flow.py", "--small", "--rounds", "1", "--json", "--write", str(tmp_path))
    assert done.code == 0, done.err
    found = json.loads(done.out)
    absent = [case.name for case in cases(SMALL, "", "") if case.needs in found["missing"]]
    assert len(found["cases"]) + len(absent) == len(list(cases(SMALL, "", "")))
    for figure in FIGURES:
        if not set(figure.cases).intersection(absent):
            assert isinstance(found[figure.key], float | int)
            assert found["minima"][figure.key] > 0
            assert found["medians"][figure.key] > 0
    assert json.loads((tmp_path / "results.json").read_text()) == found
    assert ElementTree.parse(tmp_path / "results.svg").getroot().tag.endswith("svg")


def test_what_must_come_of_the_work_is_known() -> None:
    """The hash decides, so all must come to the same counts."""
    assert expected(Work()) == Done(missions=400, completed=2000, failed=97)


@pytest.mark.long
@pytest.mark.process
def test_a_contender_that_does_other_work_is_found_out() -> None:
    """It is no figure at all, then."""
    code = (
        "from contenders.process import main; from contenders.work import Done;"
        "main(lambda work, notes: Done(missions=1, completed=2, failed=3))"
    )
    done = script("-c", code)
    assert done.code == 1
    assert "must be" in done.err


def test_a_ratio_is_of_costs_a_trip_by_minimum_and_by_median() -> None:
    """However many trips each of the two has flown."""
    known = {"thesis": measured(10, 8.0, 4.0, 6.0), "ours_contended": measured(20, 4.0, 1.0, 2.0)}
    ((figure, spread),) = figures(known)
    assert figure.key == "times_thesis"
    assert spread == Spread(minimum=8.0, median=6.0)
    assert not figure.kept(spread.minimum)
    assert figure.kept(80.0)


def test_a_picture_has_its_numbers_as_text_and_the_shortest_bar_first() -> None:
    """So it can be read aloud, and searched."""
    bars = [Bar(name="slow & old", number=250.0), Bar(name="quick", number=2.5, ours=True)]
    drawn = chart("Costs", "µs", [Group(heading="Here", bars=bars)])
    root = ElementTree.fromstring(drawn)
    name = "{http://www.w3.org/2000/svg}"
    texts = ["".join(text.itertext()) for text in root.iter(f"{name}text")]
    assert texts[-5:] == ["Here", "quick", "2.50", "slow & old", "250"]
    widths = [float(bar.get("width", "")) for bar in root.iter(f"{name}rect")][1:]
    assert widths == sorted(widths)
    assert "prefers-color-scheme: dark" in drawn


def test_the_page_shows_what_was_measured() -> None:
    """`python benchmarks/page.py` writes it anew."""
    results = json.loads((DOCS / "benchmarks" / "results.json").read_text())
    page = (DOCS / "benchmarks.md").read_text()
    assert rewritten(page, results) == page
    assert (DOCS / "benchmarks" / "results.svg").read_text() == picture(results)


def test_only_what_costs_more_than_the_tolerance_is_told() -> None:
    """And how much more it is."""
    before = {"ours": 1000, "ours_virtual": 1000}
    assert not list(instructions.compared({"ours": 1030, "ours_virtual": 900}, before))
    (line,) = instructions.compared({"ours": 1031, "ours_virtual": 1000}, before)
    assert "3.1%" in line


@pytest.mark.long
@pytest.mark.process
def test_a_trip_costs_no_more_instructions_than_it_did() -> None:
    """Counted by valgrind, where it is there and Python is the build that the counts are of."""
    reason = instructions.why_not()
    if reason is not None:
        pytest.skip(reason)
    done = script("instructions.py")
    assert done.code == 0, done.out + done.err
