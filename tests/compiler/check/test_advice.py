"""What the checks advise is what was left out, and following it leaves no error of that code."""

from __future__ import annotations

import pytest

from tests.compiler.check.graphs import BASIC, build, findings

ENDS = "    watch -> end otherwise\n"
BACK = f"    watch -> allocate when STANDBY\n{ENDS}"
FORKED = f"""{BASIC}
    limit = MissionModifier writes note
    first = GateFIFO
    start -> create -> allocate -> launch -> [watch, limit] -> first
    first -> allocate when STANDBY
    first -> end otherwise
"""
CLOCK = f"{BASIC}    wait = Clock\n"

ADVICE = {
    "a launcher that no way leads through": (
        f"{BASIC}    start -> create -> allocate -> watch\n{BACK}",
        "P2022", "write `allocate -> launch -> watch`"),
    "a launcher that only another way leads through": (
        f"{BASIC}    start -> create -> allocate -> watch\n    launch -> watch\n{BACK}",
        "P2022", "write `allocate -> launch` instead of `allocate -> watch`"),
    "no launcher": (
        BASIC.replace("launch = TripLauncher", "")
        + f"    start -> create -> allocate -> watch\n{BACK}",
        "P2022", "declare `trip_launcher = TripLauncher`, then write `allocate -> trip_launcher -> watch`"),
    "no launcher before a fork": (
        BASIC.replace("launch = TripLauncher", "timer = TimerMonitor\n    first = GateFIFO")
        + "    start -> create -> allocate -> [watch, timer] -> first\n"
        + BACK.replace("watch", "first"),
        "P2022", "write `allocate -> trip_launcher -> [watch, timer]`"),
    "neither allocator nor launcher": (
        ("    create = MissionCreator\n    watch = TripMonitor\n    start -> create -> watch\n"
        "    watch -> end\n"),
        "P2022", "write `create -> drone_allocator -> trip_launcher -> watch`"),
    "no allocator": (
        ("    create = MissionCreator\n    launch = TripLauncher\n    watch = TripMonitor\n"
        f"    start -> create -> launch -> watch\n    watch -> launch when STANDBY\n{ENDS}"),
        "P2021", ("declare `drone_allocator = DroneAllocator`, then lead every arrow to `launch` to "
        "`drone_allocator` instead, and write `drone_allocator -> launch`")),
    "an allocator that only another way leads through": (
        f"{BASIC}    start -> create -> launch -> watch\n    allocate -> launch\n{BACK}",
        "P2021", "write `create -> allocate` instead of `create -> launch`"),
    "an arrow with a guard past the allocator": (
        (f"{BASIC}    start -> create -> allocate -> launch -> watch\n"
        f"    watch -> launch when STANDBY\n{ENDS}"),
        "P2021", "write `watch -> allocate when STANDBY` instead of `watch -> launch`"),
    "a flight that a modifier brings to a gate": (
        FORKED, "P2009", "write `modifier limit_hook emits STANDBY, COMPLETED, FAILED writes note`"),
    "a flight that a modifier brings to a gate, and on to a monitor": (
        f"{FORKED}    first -> watch when RUNNING\n",
        "P2016", "write `modifier limit_hook emits STANDBY, COMPLETED, FAILED writes note`"),
    "a flight that comes to a gate at once": (
        (f"{BASIC}    first = GateFIFO\n    start -> create -> allocate -> launch -> [watch, first]\n"
        f"    watch -> first\n{BACK.replace('watch', 'first')}"),
        "P2009", "end each branch with a block that watches the flight"),
    "a clock beside a monitor": (
        (f"{CLOCK}    first = GateFIFO\n"
        "    start -> create -> allocate -> launch -> [watch, wait] -> first\n"
        f"{BACK.replace('watch', 'first')}"),
        "P2007", "put it before a drone is allocated, as in `create -> wait -> allocate`"),
    "a clock beside the allocator": (
        (f"{CLOCK}    first = GateFIFO\n"
        "    start -> create -> [wait, allocate] -> first -> launch -> watch\n"
        f"{BACK}"),
        "P2012", "put it before a drone is allocated, as in `create -> wait -> allocate`"),
}  # fmt: skip


@pytest.mark.parametrize("what", ADVICE)
def test_one_finding_names_the_cause_and_says_what_to_write(what: str) -> None:
    text, code, advice = ADVICE[what]
    (found,) = findings(text)
    assert found.code == code
    assert found.help is not None
    assert advice in found.help


def test_no_arrow_is_proposed_to_the_block_that_makes_missions() -> None:
    text = f"{BASIC}    note = MissionModifier emits UNEXECUTED\n    start -> create -> note\n"
    text += f"    note -> launch when STANDBY\n    launch -> watch\n{BACK}"
    assert not any("-> create" in (found.help or "") for found in findings(text))


def test_forks_that_fly_before_their_gate_hide_no_other_mistake() -> None:
    """What is wrong before the fork is told with it."""
    text = f"{BASIC}    wait = Clock\n    one = MissionModifier\n    other = MissionModifier\n"
    text += "    one -> other -> one\n    start -> create -> [wait, allocate] -> launch -> watch\n"
    assert build(text).kinds
    assert {found.code for found in findings(text + BACK)} == {"P2006", "P2012"}
