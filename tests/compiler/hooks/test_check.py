"""What is said of a hooks.py, and what is believed; and what `--add-stubs` adds.

`modules.txt` has modules of hooks for `crop.pluto`, an app with a hook of each kind, and what is found in them.
"""

from __future__ import annotations

import ast
from inspect import iscoroutinefunction
from pathlib import Path

import pytest

from plutoc.compile import analyse, check_hooks, policies_for_all
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.edits import applied
from plutoc.emit.hooks_tests import hooks_test
from plutoc.hooks.add import with_stubs
from plutoc.hooks.awaits import MUST_BE_AWAITED
from plutoc.source import Source
from plutoc_runtime.hooks.context import Context, LiveDrone
from tests.kit.findings import findings
from tests.kit.sections import Section, compare, params

APP = Path(__file__).with_name("crop.pluto").read_text(encoding="utf-8")
CROP = analyse(Source("app.pluto", APP))[0]
GOOD = """
from . import Verdict
def pollinate(drone, trip, context, *, dose): ...
def find_blooms(mission, results): return Verdict(ok=True)
def limit_trip(mission, context, *, limit): return mission.status
def by_battery(trip, candidates): return candidates[0]
"""


def found(hooks: Source, app: str = APP) -> tuple[Diagnostic, ...]:
    """Return what is found in a hooks.py."""
    try:
        return check_hooks(CROP if app == APP else analyse(Source("app.pluto", app))[0], hooks)
    except Rejected as rejected:
        return rejected.diagnostics


@pytest.mark.parametrize("case", params(Path(__file__).with_name("modules.txt")))
def test_of_hooks_just_this_is_said(case: Section, update: bool) -> None:
    """In the order of the app; and what mends a finding leaves nothing to be said."""
    hooks = Source("hooks.py", f"{case.given}\n")
    said = found(hooks)
    compare(case, findings(said), update)
    if said and all(each.fix for each in said):
        mended = applied(hooks, [each.fix for each in said if each.fix])
        assert found(Source("hooks.py", mended)) == ()


def test_the_methods_are_those_that_must_be_awaited() -> None:
    """All `async def` of what hooks are given, and no others."""
    for of in (Context, LiveDrone):
        waits = {name for name, what in vars(of).items() if iscoroutinefunction(what)}
        assert {name for name in waits if not name.startswith("_")} == MUST_BE_AWAITED[of.__name__]


def test_a_type_of_thousands_of_parts_is_read() -> None:
    """Without recursion."""
    wide = f"by_battery(trip: {'Trip | ' * 1500}Trip, candidates)"
    hooks = "from . import Trip\n" + GOOD.replace("by_battery(trip, candidates)", wide)
    assert found(Source("hooks.py", hooks)) == ()


def test_stubs_make_any_hooks_complete() -> None:
    """An empty file, and one of which only the last hook is there."""
    for text in ("", '"""Mine."""\n', "import os\n\nx = os.sep\n", "def by_battery(a, b): ...\n"):
        grown = with_stubs(CROP, Source("hooks.py", text))
        assert found(Source("hooks.py", grown)) == ()
        ast.parse(grown)
        for line in text.splitlines():
            assert line in grown
        assert with_stubs(CROP, Source("hooks.py", grown)) == grown


def test_stubs_import_what_they_name_once() -> None:
    """What is imported already is not imported again; and what is no Python has to be mended first."""
    grown = with_stubs(CROP, Source("hooks.py", "from . import Drone, Trip as Trip\n\nx = 1\n"))
    lines = [line for line in grown.splitlines() if "import" in line]
    assert lines == [
        "from . import Drone, Trip as Trip",
        "from collections.abc import Sequence",
        "from . import Context, Mission, Results, Status, Verdict",
    ]
    assert with_stubs(CROP, Source("hooks.py", "def (")) == "def ("


def test_the_test_of_a_policy_is_written_for_its_shape() -> None:
    """It is written once, when there may be a hooks.py already."""
    for_all = GOOD.replace("by_battery(trip, candidates)", "by_battery(all, free, at)")
    assert policies_for_all(CROP, Source("hooks.py", GOOD)) == frozenset()
    assert policies_for_all(CROP, Source("hooks.py", for_all)) == {"by_battery"}
    assert "hooks.by_battery, waiting, [drone], 0.0" in hooks_test(CROP, frozenset({"by_battery"}))
    assert "hooks.by_battery, trip, [drone]" in hooks_test(CROP)


def test_a_modifier_without_emits_returns_nothing() -> None:
    """A status that it returned would be a fault."""
    app = """pluto 1
app crop {
  modifier look
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  spoken = MissionModifier(hook: look)
  start -> create -> spoken -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end
}
"""
    hooks = "from . import Status\ndef look(mission, context) -> Status: ...\n"
    (one,) = found(Source("hooks.py", hooks), app)
    assert (one.code, one.label) == ("P3014", "must be `None`")


def test_a_creator_may_never_make_a_mission() -> None:
    """It may do something else: `-> None` is as right as `-> Mission | None`."""
    app = """pluto 1
app crop {
  creator tell
  create = MissionCreator
  told = MissionCreator(hook: tell)
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  start -> create -> allocate -> launch -> watch
  lost -> told -> allocate
  watch -> allocate when STANDBY
  watch -> end
}
"""
    hooks = 'async def tell(event, context) -> None:\n    context.log("lost")\n'
    assert found(Source("hooks.py", hooks), app) == ()
