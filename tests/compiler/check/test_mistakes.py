"""Graphs with one mistake each: that one is reported, where it is, and nothing else."""

from __future__ import annotations

import pytest

from plutoc.diagnostic import Diagnostic, Severity
from tests.compiler.check.graphs import BASIC, GATED, build, findings

LOOP = "    watch -> allocate when STANDBY\n    watch -> end\n"
STRAIGHT = f"    start -> create -> allocate -> launch -> watch\n{LOOP}"
OUT = "    first -> allocate when STANDBY\n    first -> end\n"
OPEN = GATED.replace("[watch, timer] -> first", "[watch, timer]")
FLOWN = f"""{BASIC}
    start -> create -> allocate -> launch -> watch -> allocate when STANDBY
    watch -> end when FAILED
"""
REPEATED = f"""{FLOWN}
    again = MissionRepeater
    watch -> again when COMPLETED
    again -> allocate when STANDBY
"""
JUDGED = f"""{FLOWN}
    judge = MissionEvaluator
    watch -> judge when COMPLETED
    judge -> allocate when STANDBY
    judge -> end when FAILED
"""
BRANCHED = f"""{FLOWN}
    again = MissionRepeater
    note = MissionModifier
    all = GateFunnel
    watch -> [again, note] when COMPLETED
    again -> all when STANDBY
    note -> all
    all -> allocate when STANDBY
    all -> end
"""

MISTAKES = {
    "no block makes missions": ("P2001", "", "allocate = DroneAllocator\nstart -> allocate"),
    "a second block makes missions": ("P2002", "other",
     f"{BASIC}    other = MissionCreator\n{STRAIGHT}    other -> allocate"),
    "start leads nowhere": ("P2003", "create",
     f"{BASIC}    create -> allocate -> launch -> watch\n{LOOP}"),
    "start leads to another block as well": ("P2004", "start -> [create",
     f"{BASIC}    start -> [create, allocate]\n    create -> allocate -> launch -> watch\n{LOOP}"),
    "an arrow leads back to the creator": ("P2005", "watch -> create",
     (f"{BASIC}    start -> create -> allocate -> launch -> watch\n"
      "    watch -> create\n    watch -> end")),
    "an island": ("P2006", "one",
     (f"{BASIC}{STRAIGHT}    one = MissionModifier\n    two = MissionModifier\n"
      "    three = MissionModifier\n    one -> two -> one\n    two -> three -> end")),
    "a block that never gets what it accepts": ("P2007", "again",
     f"{BASIC}{STRAIGHT}    again = MissionRepeater\n    create -> again\n    again -> end"),
    "a guard that never applies": ("P2008", "create -> launch",
     f"{BASIC}{STRAIGHT}    create -> launch when STANDBY"),
    "a launch that nothing watches": ("P2009", "launch",
     BASIC.replace("watch = TripMonitor", "judge = MissionEvaluator")
     + "    start -> create -> allocate -> launch -> judge\n    judge -> end"),
    "no arrow takes STANDBY": ("P2009", "watch",
     f"{BASIC}    start -> create -> allocate -> launch -> watch -> end"),
    "a loop without a way out": ("P2010", "one",
     (f"{BASIC}    one = MissionModifier\n    two = MissionModifier\n"
      "    start -> create -> allocate -> launch -> watch -> allocate when STANDBY\n"
      "    watch -> end when COMPLETED\n    watch -> one when FAILED\n    one -> two -> one")),
    "a repeater that leads back to itself": ("P2025", "again",
     (f"{BASIC}    again = MissionRepeater\n"
      "    start -> create -> allocate -> launch -> watch -> allocate when STANDBY\n"
      "    watch -> end when FAILED\n    watch -> again when COMPLETED\n"
      "    again -> again when COMPLETED\n    again -> allocate when STANDBY")),
    "a repeater that a modifier leads back to": ("P2025", "look",
     f"{REPEATED}    look = MissionModifier\n    again -> look when COMPLETED\n    look -> again"),
    "a repeater in a loop of forks": ("P2025", "look",
     (f"{REPEATED}    look = MissionModifier\n    note = MissionModifier\n    all = GateFunnel\n"
      "    again -> [look, note] when COMPLETED\n    [look, note] -> all -> again")),
    "an evaluator that leads back to itself": ("P2025", "judge",
     f"{JUDGED}    judge -> judge when COMPLETED"),
    "an evaluator and a repeater that lead to each other": ("P2025", "judge",
     (f"{JUDGED}    again = MissionRepeater\n    judge -> again when COMPLETED\n"
      "    again -> judge when COMPLETED\n    again -> allocate when STANDBY")),
    "an evaluator beside a modifier, again and again": ("P2025", "all",
     (f"{FLOWN}    judge = MissionEvaluator\n    mark = MissionModifier\n"
      "    note = MissionModifier\n    all = GateFIFO\n"
      "    watch -> mark when COMPLETED\n    mark -> [judge, note] -> all\n"
      "    all -> mark when COMPLETED\n    all -> allocate when STANDBY\n"
      "    all -> end when FAILED")),
    "an evaluator's FAILED that a hook takes back, and that is asked for again": ("P2025", "mend",
     (f"{JUDGED.replace('judge -> end', 'judge -> mend')}    judge -> end when COMPLETED\n"
      "    mend = MissionModifier emits COMPLETED, FAILED\n"
      "    mend -> judge when COMPLETED\n    mend -> end when FAILED")),
    "a loop that only a hook which fails the mission would leave": ("P2025", "mend",
     (f"{REPEATED}    mend = MissionModifier emits COMPLETED, FAILED\n"
      "    again -> mend when COMPLETED\n    mend -> again when COMPLETED\n"
      "    mend -> end when FAILED")),
    "such a loop in a branch whose gate waits": ("P2025", "mend",
     (f"{BRANCHED}    mend = MissionModifier emits COMPLETED, FAILED\n"
      "    again -> mend when COMPLETED\n    mend -> again when COMPLETED\n"
      "    mend -> all when FAILED")),
    "a branch that goes round a repeater and a modifier": ("P2014", "watch -> [again",
     (f"{BRANCHED}    look = MissionModifier\n    again -> look when COMPLETED\n"
      "    look -> again")),
    "an allocator behind an evaluator's FAILED": ("P2008", "other -> second",
     (f"{JUDGED.replace('judge -> end', 'judge -> other')}    judge -> end when COMPLETED\n"
      "    other = DroneAllocator\n    second = TripLauncher\n    see = TripMonitor\n"
      "    other -> second -> see\n    see -> allocate when STANDBY\n    see -> end")),
    "an allocation behind an evaluator's FAILED, and what else comes": ("P2008", "other -> second",
     (f"{JUDGED.replace('judge -> end', 'judge -> other')}    judge -> end when COMPLETED\n"
      "    other = DroneAllocator\n    second = TripLauncher\n    see = TripMonitor\n"
      "    other -> second otherwise\n    second -> see\n"
      "    see -> allocate when STANDBY\n    see -> end")),
    "a retry behind an evaluator's FAILED": ("P2008", "mend -> allocate",
     (f"{JUDGED.replace('judge -> end', 'judge -> mend')}    judge -> end when COMPLETED\n"
      "    mend = PriorityManager\n    mend -> allocate when STANDBY\n    mend -> end")),
    "a graph without an end": ("P2010", "watch",
     (f"{BASIC}    mend = MissionModifier emits STANDBY\n"
      "    start -> create -> allocate -> launch -> watch -> mend -> allocate")),
    "a branch that reaches the end": ("P2011", "launch -> note",
     (f"{OPEN}    note = MissionModifier\n    done = MissionModifier emits COMPLETED\n"
      f"    launch -> note -> done -> end\n    [watch, timer] -> first\n{OUT}")),
    "a branch that ends without saying so": ("P2011", "launch -> done",
     (f"{OPEN}    done = MissionModifier emits COMPLETED\n"
      f"    launch -> done\n    [watch, timer] -> first\n{OUT}")),
    "a forgotten gate": ("P2012", "[watch, timer]",
     (f"{BASIC}    timer = TimerMonitor\n"
      "    start -> create -> allocate -> launch -> [watch, timer]\n"
      "    [watch, timer] -> allocate when STANDBY\n    [watch, timer] -> end")),
    "branches that stop before their gate": ("P2009", "watch = ", f"{OPEN}{OUT}"),
    "branches that stop where there is no gate": ("P2009", "watch = ",
     (f"{BASIC}    timer = TimerMonitor\n"
      "    start -> create -> allocate -> launch -> [watch, timer]")),
    "a branch that stops beside one that closes": ("P2009", "timer = ",
     f"{OPEN}    watch -> first\n{OUT}"),
    "a branch that is launched in parallel": ("P2012", "create -> [allocate, note]",
     (f"{BASIC}    note = MissionModifier\n    gate = GateFIFO\n"
      "    start -> create -> [allocate, note]\n    note -> gate -> allocate\n"
      f"    allocate -> launch -> watch\n{LOOP}")),
    "a different gate for each branch": ("P2013", "[watch, timer]",
     (f"{OPEN}    other = GateFIFO\n    watch -> first\n    timer -> other\n{OUT}"
      f"{OUT.replace('first', 'other')}")),
    "a gate within a branch": ("P2013", "[watch, timer]",
     f"{OPEN}    other = GateFIFO\n    watch -> other -> first\n    timer -> first\n{OUT}"),
    "a branch that goes round for ever": ("P2014", "launch -> spin",
     f"{GATED}    spin = MissionModifier\n    launch -> spin -> spin\n{OUT}"),
    "a gate that waits for a branch in vain": ("P2015", "first",
     (f"{GATED.replace('FIFO', 'Funnel')}    spin = MissionModifier\n"
      f"    launch -> spin -> spin\n{OUT}")),
    "a way to a gate outside of its fork": ("P2016", "first",
     (f"{GATED}    again = MissionRepeater\n    first -> again when COMPLETED\n"
      f"    again -> first when COMPLETED\n    again -> allocate when STANDBY\n{OUT}")),
    "a gate without a fork": ("P2017", "first",
     (f"{BASIC}    first = GateFIFO\n    start -> create -> allocate -> launch -> watch -> first\n"
      f"{OUT}")),
    "clones that multiply": ("P2018", "one -> [two, allocate]",
     (f"{BASIC}    one = MissionModifier\n    two = MissionModifier\n"
      "    start -> create -> one -> [two, allocate]\n    two -> one\n"
      f"    allocate -> launch -> watch\n{LOOP}")),
    "two forks, one in the other, at one gate": ("P2019", "note -> [one, two]",
     (f"{OPEN}    note = MissionModifier\n    one = MissionModifier emits COMPLETED\n"
      "    two = MissionModifier emits COMPLETED\n    launch -> note\n"
      f"    note -> [one, two]\n    [one, two, watch, timer] -> first\n{OUT}")),
    "two branches that write one attribute": ("P2020", "two",
     (f"{BASIC}    one = MissionModifier writes note\n    two = MissionModifier writes more, note\n"
      "    gate = GateFunnel\n    start -> create -> [one, two] -> gate -> allocate\n"
      f"    allocate -> launch -> watch\n{LOOP}")),
    "a launch without a drone": ("P2021", "launch",
     (f"{BASIC}    start -> create -> allocate -> launch -> watch -> launch when STANDBY\n"
      "    watch -> end")),
    "a monitor without a launch": ("P2022", "watch",
     (f"{BASIC}    pretend = MissionModifier emits RUNNING\n"
      f"    start -> create -> pretend -> watch\n    allocate -> launch -> watch\n{LOOP}")),
    "a limit with nothing beside it": ("P2023", "watch",
     f"{BASIC.replace('TripMonitor', 'TimerMonitor')}{STRAIGHT}"),
    "a limit beside another limit": ("P2023", "watch",
     (f"{BASIC.replace('TripMonitor', 'GapMonitor')}    note = MissionModifier\n"
      "    first = GateFunnel\n"
      f"    start -> create -> allocate -> launch -> [watch, note] -> first\n{OUT}")),
}  # fmt: skip


def errors(text: str) -> list[Diagnostic]:
    """The errors; warnings that the example happens to have do not count."""
    return [d for d in findings(text) if d.severity is Severity.ERROR]


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_reported_once_and_where_it_is(name: str) -> None:
    """One code, no cascade, and the marked place is the one to look at."""
    code, place, text = MISTAKES[name]
    found = errors(text)
    assert [d.code for d in found] == [code], [f"{d.code}: {d.message}" for d in found]
    assert found[0].help
    source = build(text).source
    line, _ = source.position(found[0].span.start)
    assert place in source.line(line)


def test_a_stuck_mission_is_shown_the_way_out_and_the_way_there() -> None:
    """The help names the arrow to add, and the shortest way that shows it."""
    (found,) = errors(MISTAKES["no arrow takes STANDBY"][2])
    assert found.help == (
        "add `watch -> allocate when STANDBY`\n"
        "the shortest way there:\n"
        "  create (UNEXECUTED) → allocate (UNEXECUTED) → launch (RUNNING) → watch (STANDBY)"
    )


@pytest.mark.parametrize(
    ("name", "meet"),
    [
        (
            "branches that stop before their gate",
            "to `first`: add `watch -> first` and `timer -> first`;",
        ),
        ("a branch that stops beside one that closes", "to `first`: add `timer -> first`;"),
        ("branches that stop where there is no gate", "let its branches meet at a gate;"),
    ],
)
def test_a_mission_stuck_in_a_fork_is_shown_the_gate(name: str, meet: str) -> None:
    """Any other way out would be refused: a branch must close at its gate first."""
    (found,) = errors(MISTAKES[name][2])
    assert found.help is not None
    assert meet in found.help


def test_what_follows_an_open_fork_is_not_guessed() -> None:
    """That no block retries is not said where a branch stops before the gate that leads there."""
    text = f"{OPEN}    first -> allocate when STANDBY, FAILED\n    first -> end"
    assert [found.code for found in findings(text)] == ["P2009"]


def test_the_status_to_take_is_the_one_that_the_way_shows() -> None:
    """Of several statuses that are left, the arrow that is proposed can take the one it names."""
    text = f"""{BASIC}
    note = MissionModifier emits RUNNING, STANDBY, COMPLETED
    start -> create -> allocate -> launch -> watch -> note
    note -> end"""
    (found,) = errors(text)
    assert found.help is not None
    assert found.help.startswith("add `note -> watch when RUNNING`\n")
    assert found.help.endswith("watch (STANDBY)\n    → note (RUNNING)")


def test_a_way_through_a_gate_goes_back_to_the_fork_it_came_from() -> None:
    """Two forks share a gate: the way to what lies behind the second passes the second."""
    text = f"""{BASIC}
    one = MissionModifier
    two = MissionModifier
    gate = GateFunnel
    start -> create -> [one, two] -> gate
    gate -> allocate when UNEXECUTED
    gate -> end
    allocate -> launch -> watch -> [one, two]"""
    (found,) = errors(text)
    assert found.code == "P2009"
    assert found.help is not None
    assert found.help.endswith(
        "  create (UNEXECUTED) → one (UNEXECUTED) → gate (UNEXECUTED) → allocate (UNEXECUTED)\n"
        "    → launch (RUNNING) → watch (STANDBY) → one (STANDBY) → gate (STANDBY)"
    )


def test_all_mistakes_of_a_graph_are_reported_in_one_run() -> None:
    """Two mistakes far apart are two messages."""
    text = f"{BASIC}{STRAIGHT}    lost = MissionModifier\n    create -> launch when STANDBY"
    assert [d.code for d in errors(text)] == ["P2006", "P2008"]


def test_a_forgotten_gate_names_every_branch() -> None:
    """The other branches are pointed at, not reported again."""
    (found,) = errors(MISTAKES["a forgotten gate"][2])
    assert [related.label for related in found.related] == [
        "the branch to `timer` reaches `allocate` first, too"
    ]


def test_an_island_names_what_hangs_on_it() -> None:
    """One message for the whole island."""
    (found,) = errors(MISTAKES["an island"][2])
    assert found.message == "no path from `start` reaches `one`, nor `two` and `three` behind it"
