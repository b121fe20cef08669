"""How missions that were interrupted come into a plan, as text."""

from __future__ import annotations

from plutoc.plan.build import build
from plutoc.plan.optimise import optimised
from plutoc.plan.show import show
from tests.compiler.check.graphs import BASIC, checked
from tests.compiler.plan.graphs import NESTED_LOOPS

LOOP_THAT_ASKS = f"""{BASIC}
    second = DroneAllocator
    again = TripLauncher
    see = TripMonitor
    start -> create -> allocate -> launch -> watch
    watch -> second when STANDBY
    watch -> end otherwise
    second -> again -> see
    see -> allocate when STANDBY
    see -> end otherwise"""
CLOCKS = [f"wait{n}" for n in range(50)]
CHAIN = "\n".join(
    [
        BASIC,
        *(f"{name} = Clock" for name in CLOCKS),
        f"start -> create -> {' -> '.join(CLOCKS)} -> allocate -> launch -> watch",
        "watch -> wait0 when STANDBY",
        "watch -> end",
    ]
)
"""More blocks where missions go on than are asked for one by one."""


def shown(text: str) -> str:
    """Return the optimised plan without its first line."""
    plan = show(optimised(build(checked(text))))
    return "\n" + plan.partition("\n")[2].partition("left out:")[0]


def test_what_stands_before_the_only_block_is_passed_over() -> None:
    text = f"""{BASIC}
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end"""
    assert shown(text) == """
  enter
    begin -> create:
      call create
    allocate -> allocate: go on
  loop allocate
    call allocate
    call launch
    watch watch
    switch
      COMPLETED, FAILED -> end: end
      STANDBY -> allocate: go on
"""


def test_a_loop_that_was_entered_at_two_blocks_begins_at_the_later_one() -> None:
    """The other stands before it and at its end, so no trip is asked anything."""
    assert shown(NESTED_LOOPS) == """
  enter
    begin -> create:
      call create
    wait, allocate -> wait: go on
  enter
    begin, wait -> wait:
      call wait
    allocate -> allocate: go on
  loop allocate
    call allocate
    call launch
    watch watch
    switch
      COMPLETED -> end: end
      STANDBY -> wait:
        call wait
        continue
      FAILED -> retry: go on
    call retry
    switch
      FAILED -> end: end
      STANDBY -> allocate: go on
"""


def test_who_goes_on_before_a_loops_head_finds_a_copy_there() -> None:
    text = f"""{BASIC}
    retry = PriorityManager
    rest = Clock
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> retry when FAILED
    retry -> rest -> allocate when STANDBY
    retry -> end otherwise
    watch -> end when COMPLETED"""
    assert shown(text) == """
  enter
    begin -> create:
      call create
    rest, allocate -> rest: go on
  enter
    rest -> rest:
      call rest
    begin, allocate -> allocate: go on
  loop allocate
    call allocate
    call launch
    watch watch
    switch
      STANDBY -> allocate: continue
      COMPLETED -> end: end
      FAILED -> retry: go on
    call retry
    switch
      FAILED -> end: end
      STANDBY -> rest: go on
    call rest
"""


def test_a_loop_asks_where_much_lies_before_its_head() -> None:
    """And who has come to the block is asked no more."""
    assert shown(LOOP_THAT_ASKS) == """
  enter
    begin -> create:
      call create
    allocate, second -> allocate: go on
  loop allocate
    enter
      begin, allocate -> allocate:
        call allocate
        call launch
        watch watch
        switch
          COMPLETED, FAILED -> end: end
          STANDBY -> second: go on
      second -> second: go on
    arrived
    call second
    call again
    watch see
    switch
      COMPLETED, FAILED -> end: end
      STANDBY -> allocate: go on
"""


def test_nothing_is_asked_whose_answer_is_certain() -> None:
    """A mission that begins goes on nowhere, and has not come from where others go on."""
    text = f"""{BASIC}
    choose = MissionModifier emits UNEXECUTED, STANDBY
    wait = Clock
    start -> create -> choose
    choose -> wait when UNEXECUTED
    choose -> allocate when STANDBY
    wait -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end"""
    assert shown(text).startswith("""
  enter
    begin -> create:
      call create
      call choose
      switch
        UNEXECUTED -> wait:
          call wait
        STANDBY -> allocate: go on
    wait, allocate -> wait:
      enter
        wait -> wait:
          call wait
        allocate -> allocate: go on
  loop allocate
""")


def test_without_structure_missions_go_on_at_a_case() -> None:
    first, *rest = shown(CHAIN).strip().splitlines()
    assert first.startswith("dispatch from create, allocate, wait0, wait1, ")
    assert [line.strip() for line in rest if line.startswith("    case wait")] == [
        f"case wait{n}" for n in range(50)
    ]
