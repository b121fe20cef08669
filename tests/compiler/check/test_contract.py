"""What a graph's meaning says is an error, or worth a warning: each has its diagnostic, no other has.

The words are those of the rule; the apps are in `test_mistakes`, `test_resume` and `test_warnings`.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import plutoc.check
from plutoc.diagnostic import Severity
from tests.compiler.check.graphs import codes, findings
from tests.compiler.check.test_mistakes import MISTAKES
from tests.paths import CASES

CHECKS = Path(plutoc.check.__file__).parent

ERRORS = {
    "exactly one block makes missions": ("P2001", "P2002"),
    "`start` leads there, and nothing leads back": ("P2003", "P2004", "P2005"),
    "a block that no path reaches": ("P2006",),
    "a reachable block that never gets a status it accepts": ("P2007",),
    "an edge that no status can ever take": ("P2008",),
    "a stuck mission": ("P2009",),
    "a graph or loop from which no end can be reached": ("P2010", "P2025"),
    "a branch that reaches the end, or ends, before its gate": ("P2011",),
    "a branch that is flown twice": ("P2012",),
    "a branch that does not close at its fork's gate": ("P2013", "P2014", "P2018"),
    "a gate that waits for a branch that cannot arrive": ("P2015",),
    "an arrival at a gate without a fork": ("P2016", "P2017"),
    "a gate that closes fewer than two": ("P2017",),
    "forks nest": ("P2019",),
    "two parallel branches that write one attribute": ("P2020",),
    "a launch with no allocation since the previous launch": ("P2021",),
    "a monitor with no launch before it": ("P2022",),
    "a limit that is not parallel to a monitor": ("P2023",),
    "a stopped mission can go on": ("P2024",),
    "more states than are looked at": ("P2026",),
}
WARNINGS = {
    "implicit end": "P2051",
    "a guard that names, beside others, a status its block never emits": "P2052",
    "`otherwise` that takes nothing": "P2053",
    "a drone held during a delay": "P2054",
    "failed missions stop": "P2055",
    "a loop that only failures go round without a bound": "P2056",
    "repeater before evaluator": "P2057",
}


def test_each_code_of_the_checks_is_of_a_rule() -> None:
    written = {
        code
        for path in CHECKS.glob("*.py")
        for code in re.findall(r'"(P2\d\d\d)"', path.read_text())
    }
    assert written == {code for of_rule in ERRORS.values() for code in of_rule} | {
        *WARNINGS.values()
    }


def test_each_rule_that_forbids_has_an_app_that_breaks_it_alone() -> None:
    shown = {code for code, _, _ in MISTAKES.values()}
    # what goes wrong after a Stop alone is in `test_resume`, too many states in `test_loops`
    assert {code for of_rule in ERRORS.values() for code in of_rule} - shown == {"P2024", "P2026"}


@pytest.mark.parametrize("code", WARNINGS.values(), ids=list(WARNINGS))
def test_warning_is_no_error(code: str) -> None:
    reports = [path.read_text() for path in CASES.glob(f"{code.lower()}_*/report.txt")]
    assert reports
    assert all(f"warning[{code}]" in report and "error[" not in report for report in reports)


CREATE = """
    create = MissionCreator
    allocate = DroneAllocator
    launch = TripLauncher
    watch = TripMonitor
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
"""
LIMITED = CREATE.replace(
    "-> watch", "-> [watch, timer] -> first\n    timer = TimerMonitor"
).replace("watch -> allocate", "first = GateFIFO\n    first -> allocate")

ALLOWED = {
    "an end without an arrow": CREATE,
    "an unguarded arrow to the end that takes nothing": f"{CREATE}    create -> end",
    "an unguarded arrow to the end beside a retry": (
        f"{CREATE}    retry = PriorityManager\n    watch -> retry when FAILED\n    watch -> end\n"
        "    retry -> allocate when STANDBY\n    retry -> end"
    ),
    "a guard that names a status that is never emitted, beside one that is": (
        f"{CREATE}    watch -> end when COMPLETED, FAILED\n"
    ).replace("when STANDBY", "when UNEXECUTED, STANDBY"),
    "a failed mission that a guard lets into the allocator": (
        f"{CREATE}    watch -> end".replace("when STANDBY", "when STANDBY, FAILED")
    ),
    "a fork and its gate in a loop": f"{LIMITED}    first -> end",
    "two arrows to one block, by different guards": (
        f"{CREATE}    watch -> end when FAILED\n    watch -> end when COMPLETED"
    ),
    "a fork of two arrows to one block": (
        f"{LIMITED}    launch -> timer when RUNNING\n    first -> end"
    ),
    "an arrow straight to the gate": (
        f"{LIMITED.replace('GateFIFO', 'GateFunnel')}    launch -> first\n    first -> end"
    ),
}


@pytest.mark.parametrize("text", ALLOWED.values(), ids=list(ALLOWED))
def test_what_no_rule_forbids_is_allowed(text: str) -> None:
    assert [d.code for d in findings(text) if d.severity is Severity.ERROR] == [], codes(text)
