"""A flow is entered where a mission was interrupted, in few and plain lines."""

from __future__ import annotations

import pytest

from plutoc.emit.flow_file import flow_file
from plutoc.emit.render import formatted
from tests.compiler.emit.plans import plan_of

HEAD = """pluto 1
app some {
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
"""
CLOCK = """  wait = Clock
  start -> create -> wait -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end
}
"""
IN_A_LOOP = """  rest = Clock
  second = DroneAllocator
  again = TripLauncher
  see = TripMonitor
  start -> create -> allocate -> launch -> watch
  watch -> rest -> second when STANDBY
  watch -> end otherwise
  second -> again -> see
  see -> allocate when STANDBY
  see -> end otherwise
}
"""
MANY = [f"wait{n}" for n in range(50)]
CASES = f"""{"".join(f"  {name} = Clock" + chr(10) for name in MANY)}
  start -> create -> {" -> ".join(MANY)} -> allocate -> launch -> watch
  watch -> wait0 when STANDBY
  watch -> end
}}
"""


def lines_of(text: str, *, optimise: bool = True) -> list[str]:
    """Return the lines of `flow`, without those that call blocks or quote them."""
    written = formatted(flow_file(plan_of(HEAD + text, optimise=optimise)))
    body = written.partition("async def flow")[2].partition("\n\n\n")[0].splitlines()[2:]
    calls = ("#", "status = await", "status = create", "status = launch", "return", "raise")
    return [line for line in body if not line.lstrip().startswith(calls)]


@pytest.mark.parametrize("optimise", [True, False])
def test_a_mission_that_goes_on_passes_over_what_stands_before(optimise: bool) -> None:
    """Outside of loops, so a trip is asked nothing."""
    assert lines_of(CLOCK, optimise=optimise)[:4] == [
        "    status = run.status",
        "    if run.at is None:",
        '    if run.at in (None, "wait"):',
        "    while True:",
    ]


def test_in_a_loop_it_is_asked_of_a_local_name_and_forgotten_once_it_has_come() -> None:
    assert lines_of(IN_A_LOOP) == [
        "    status, at = run.status, run.at",
        "    if at is None:",
        "    while True:",
        '        if at in (None, "allocate"):',
        "            if status in (COMPLETED, FAILED):",
        '        if at != "second":',
        "            at = None",
        "        at = None",
        "        if status in (COMPLETED, FAILED):",
    ]


def test_without_structure_it_goes_on_at_a_case() -> None:
    assert lines_of(CASES)[:3] == [
        "    status = run.status",
        '    at = run.at or "create"',
        "    while True:",
    ]


def test_the_app_lists_where_missions_go_on_a_name_a_line() -> None:
    """In the order of the source."""
    written = formatted(flow_file(plan_of(HEAD + CLOCK)))
    assert '    resumes=(\n        "allocate",\n        "wait",\n    ),\n' in written
