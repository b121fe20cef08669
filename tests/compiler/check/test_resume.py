"""Where missions go on after a Stop, and what is said where they could not."""

from __future__ import annotations

import pytest

from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import BASIC, checked, codes, findings
from tests.compiler.check.test_sound_graphs import ALFALFA, SOUND

TWO_ALLOCATORS = f"""{BASIC}
    second = DroneAllocator
    start -> create -> allocate
    launch -> watch
    watch -> second when STANDBY
    second -> launch
    watch -> end"""

ONE_ALLOCATOR = f"""{BASIC}
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end"""
"""Sound, but for the warning that nothing retries."""


def test_a_stopped_mission_goes_back_to_the_nearest_block_that_waits_or_allocates() -> None:
    resumes = checked(ALFALFA).resumes
    assert resumes["wait"] == ("wait",)
    for name in ("allocate", "launch", "watch", "timer", "retry"):
        assert resumes[name] == ("allocate",)


def test_a_mission_with_nothing_left_to_fly_goes_back_to_where_its_last_drone_was_allocated() -> (
    None
):
    """From there it is told once more how its last trip ended, so no Clock makes it wait again."""
    resumes = checked(ALFALFA).resumes
    for name in ("first", "judge", "again"):
        assert resumes[name] == ("allocate",)


def test_the_blocks_at_which_missions_go_on_are_listed_with_how_they_stand() -> None:
    first = frozenset({Status.UNEXECUTED})
    both = frozenset({Status.UNEXECUTED, Status.STANDBY})
    assert checked(ALFALFA).entries == {"wait": first, "allocate": both}
    assert list(checked(ALFALFA).entries) == ["wait", "allocate"]
    assert checked(f"{TWO_ALLOCATORS}\n    allocate -> launch").entries == {
        "allocate": both,
        "second": frozenset({Status.STANDBY}),
    }


def test_what_missions_do_after_a_stop_counts() -> None:
    """Stopped on its first flight, a mission comes to `allocate` STANDBY, which it never does else."""
    found = checked(f"{TWO_ALLOCATORS}\n    allocate -> launch")
    assert Status.STANDBY in found.arrives["allocate"]


def test_a_clock_that_is_reached_with_a_drone_is_no_place_to_go_on() -> None:
    """The Stop took the drone away: behind the Clock there is no other."""
    text = f"""{BASIC}
    wait = Clock
    start -> create -> allocate -> wait -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end"""
    assert checked(text).resumes["wait"] == ("allocate",)


def test_a_clock_inside_a_fork_is_no_place_to_go_on() -> None:
    """A Stop dissolves the fork: nothing would wait for the clone any more."""
    text = f"""{BASIC}
    wait = Clock
    note = MissionModifier
    both = GateFunnel
    start -> create -> [wait, note] -> both -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end"""
    assert checked(text).resumes["wait"] == ("create",)


@pytest.mark.parametrize("name", SOUND)
def test_every_block_of_a_sound_graph_has_a_place_to_go_on(name: str) -> None:
    resumes = checked(SOUND[name]).resumes
    # what is reached only in a fork, and only when nothing is left to fly, ends with the fork
    assert all(resumes.values())


def test_a_mission_that_only_a_stop_can_strand_is_found() -> None:
    """Stopped on its first flight, it comes to `allocate` STANDBY, which it never does else."""
    text = f"{TWO_ALLOCATORS}\n    allocate -> launch when UNEXECUTED"
    (found,) = [d for d in findings(text) if d.code == "P2024"]
    assert found.message == (
        "after a Stop, a mission that leaves `allocate` STANDBY is stuck: no arrow takes it"
    )
    assert codes(f"{TWO_ALLOCATORS}\n    allocate -> launch") == codes(ONE_ALLOCATOR)


def test_the_cost_of_the_checks_is_told() -> None:
    """Three ways to end for each launch, and a branch each for the monitor and the timer."""
    assert checked(SOUND["figure 6.12, the basic graph"]).explored == 10
    assert checked(ALFALFA).explored < 100


def test_any_number_of_branches_is_explored_without_a_product_of_them() -> None:
    """Each further branch adds as many states as the first one: the exploration stays exact."""

    def explored(width: int) -> int:
        names = [f"note{n}" for n in range(width)]
        declared = "\n".join(f"    {name} = MissionModifier" for name in names)
        return checked(f"""{BASIC}
    both = GateFunnel
{declared}
    start -> create -> allocate -> launch -> [{", ".join(["watch", *names])}] -> both
    both -> allocate when STANDBY
    both -> end""").explored

    one, two, many = explored(1), explored(2), explored(40)
    assert many - one == 39 * (two - one)
