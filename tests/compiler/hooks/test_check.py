"""What a developer may write, and what `--add-stubs` adds. Findings: tests/cases/p3*."""

from __future__ import annotations

import ast

import pytest

from plutoc.check.model import Checked
from plutoc.compile import analyse, check_hooks, policies_for_all
from plutoc.diagnostic import Rejected
from plutoc.emit.hooks_tests import hooks_test
from plutoc.hooks.add import with_stubs
from plutoc.source import Source

APP = """pluto 1
app crop {
  action pollinate(dose: mass = 50 mg)
  evaluator find_blooms
  modifier limit_trip(limit: time = 3 min) emits STANDBY, COMPLETED, FAILED
  policy by_battery
  create = MissionCreator
  allocate = DroneAllocator(policy: by_battery)
  launch = TripLauncher
  watch = TripMonitor
  limit = MissionModifier(hook: limit_trip, limit: 2 min)
  first = GateFIFO
  judge = MissionEvaluator(hook: find_blooms)
  start -> create -> allocate -> launch -> [watch, limit] -> first
  first -> allocate when STANDBY
  first -> judge when COMPLETED
  first -> end when FAILED
  judge -> allocate when STANDBY
  judge -> end otherwise
}
"""

GOOD = """
from . import Verdict
def pollinate(drone, trip, context, *, dose): ...
def find_blooms(mission, results): return Verdict(ok=True)
def limit_trip(mission, context, *, limit): return mission.status
def by_battery(trip, candidates): return candidates[0]
"""


@pytest.fixture(scope="module")
def crop() -> Checked:
    """An app with a hook of each kind."""
    return analyse(Source("app.pluto", APP))[0]


def codes(checked: Checked, hooks: str) -> list[str]:
    """Return the codes of what is found in a hooks.py."""
    try:
        check_hooks(checked, Source("hooks.py", hooks))
    except Rejected as rejected:
        return [found.code for found in rejected.diagnostics]
    return []


def test_plain_functions_will_do(crop: Checked) -> None:
    """Annotations are not asked for."""
    assert codes(crop, GOOD) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("def pollinate", "async def pollinate"),
        ("def find_blooms", "async def find_blooms"),
        ("def limit_trip", "async def limit_trip"),
        ("drone, trip, context, *, dose", "drone, trip, context, dose"),
        ("drone, trip, context, *, dose", "_drone, _t, context, /, *, dose"),
        ("drone, trip, context, *, dose", "drone, trip, context, *, dose, more=1"),
        ("drone, trip, context, *, dose", "drone, trip, context, often=1, *, dose=2"),
        ("drone, trip, context, *, dose", "*args, **kwargs"),
        ("drone, trip, context, *, dose", "drone, *rest, dose"),
        ("def by_battery", "@cached\ndef by_battery"),
        ("def find_blooms(mission, results)", "@wrapped\ndef find_blooms()"),
        ("def find_blooms(mission, results): return", "find_blooms ="),
    ],
)
def test_other_ways_to_write_a_hook_are_as_good(crop: Checked, old: str, new: str) -> None:
    """What the app's call fits, and what cannot be known, is accepted."""
    assert codes(crop, GOOD.replace(old, new)) == []


def test_a_star_import_may_bring_any_hook(crop: Checked) -> None:
    """Nothing is run to find out."""
    assert codes(crop, "from .mine import *\n") == []
    assert codes(crop, "from .mine import *\nasync def by_battery(trip, candidates): ...") == [
        "P3010"
    ]


def test_the_last_definition_counts(crop: Checked) -> None:
    """As it does when Python runs it."""
    assert codes(crop, "def find_blooms(): ...\n" + GOOD) == []
    assert codes(crop, GOOD + "def find_blooms(): ...\n") == ["P3005"]


def test_all_findings_come_in_the_order_of_the_app(crop: Checked) -> None:
    """Missing ones and wrong ones."""
    hooks = "def by_battery(): ...\nclass find_blooms: ...\n"
    assert codes(crop, hooks) == ["P3003", "P3004", "P3003", "P3005"]


@pytest.mark.parametrize(
    ("parameters", "expected"),
    [
        ("dos", ["P3007"]),
        ("amount", ["P3007"]),
        ("amount, dosage", ["P3007", "P3008"]),
        ("far, off", ["P3007", "P3008", "P3008"]),
        ("dos, **others", ["P3008"]),
        ("dos=1.0", ["P3007"]),
        ("dose, dos", ["P3008"]),
    ],
)
def test_a_parameter_by_another_name_is_one_mistake(
    crop: Checked, parameters: str, expected: list[str]
) -> None:
    """Not one that is missing and one too many."""
    assert codes(crop, GOOD.replace("*, dose", f"*, {parameters}")) == expected


def test_stubs_make_any_hooks_complete(crop: Checked) -> None:
    """An empty file, and one of which only the last hook is there."""
    for text in ("", '"""Mine."""\n', "import os\n\nx = os.sep\n", "def by_battery(a, b): ...\n"):
        grown = with_stubs(crop, Source("hooks.py", text))
        assert codes(crop, grown) == []
        ast.parse(grown)
        for line in text.splitlines():
            assert line in grown
        assert with_stubs(crop, Source("hooks.py", grown)) == grown


def test_stubs_import_what_they_name_once(crop: Checked) -> None:
    """What is imported already is not imported again."""
    grown = with_stubs(crop, Source("hooks.py", "from . import Drone, Trip as Trip\n\nx = 1\n"))
    lines = [line for line in grown.splitlines() if "import" in line]
    assert lines == [
        "from . import Drone, Trip as Trip",
        "from collections.abc import Sequence",
        "from . import Context, Mission, Results, Status, Verdict",
    ]


def test_nothing_is_added_to_what_is_not_python(crop: Checked) -> None:
    """First it has to be mended."""
    source = Source("hooks.py", "def (")
    assert with_stubs(crop, source) == source.text


@pytest.mark.parametrize(
    ("probe", "wanted"),
    [
        ("async def pollinate_done(drone: Drone, trip: Trip) -> bool | None: return None", []),
        ("def pollinate_done(drone, trip): return True", []),
        ("pollinate_done = None", []),
        ("def pollinate_done(drone): return True", ["P3005"]),
        ("def pollinate_done(trip, drone): return True", ["P3006"]),
        ("def pollinate_done(drone, trip, dose): return True", ["P3008"]),
        ("def pollinate_done(drone, trip) -> str: return 'yes'", ["P3014"]),
    ],
)
def test_what_tells_whether_an_action_was_done_is_looked_at(
    crop: Checked, probe: str, wanted: list[str]
) -> None:
    """It need not be there; where it is, the app can call it after a crash."""
    text = GOOD.replace("import Verdict", "import Drone, Trip, Verdict") + probe
    assert codes(crop, text) == wanted


@pytest.mark.parametrize(
    ("parameters", "found"),
    [
        ("(trip, candidates)", []),
        ("(waiting, drones, now)", []),
        ("(a, b, c)", []),
        ("(a, b, c=1)", []),
        ("(a, b, /, c)", []),
        ("(*given)", []),
        ("(waiting)", ["P3005"]),
        ("(waiting, now, drones)", ["P3006"]),
        ("(trip, candidates, now)", ["P3008"]),
        ("(waiting, drones, now, *, more)", ["P3008"]),
        ("(a, b, c, d)", ["P3008", "P3008"]),
    ],
)
def test_a_policy_has_one_of_two_shapes(crop: Checked, parameters: str, found: list[str]) -> None:
    """Three parameters without a default are those of all that wait."""
    hooks = GOOD.replace(
        "by_battery(trip, candidates): return candidates[0]", f"by_battery{parameters}: ..."
    )
    assert codes(crop, hooks) == found


def test_help_for_a_policy_that_chooses_for_all_shows_that_shape(crop: Checked) -> None:
    hooks = GOOD.replace(
        "def by_battery(trip, candidates)", "async def by_battery(waiting, drones, now)"
    )
    with pytest.raises(Rejected) as rejected:
        check_hooks(crop, Source("hooks.py", hooks))
    (found,) = rejected.value.diagnostics
    assert found.help is not None
    assert (
        "(waiting: Sequence[Waiting], drones: Sequence[Drone], now: float) -> Assignment"
        in found.help
    )


def test_the_test_of_such_a_policy_is_written_for_its_shape(crop: Checked) -> None:
    """It is written once, when there may be a hooks.py already."""
    hooks = Source(
        "hooks.py", GOOD.replace("by_battery(trip, candidates)", "by_battery(all, free, at)")
    )
    assert policies_for_all(crop, Source("hooks.py", GOOD)) == frozenset()
    assert policies_for_all(crop, hooks) == {"by_battery"}
    assert "hooks.by_battery, waiting, [drone], 0.0" in hooks_test(crop, frozenset({"by_battery"}))
    assert "hooks.by_battery, trip, [drone]" in hooks_test(crop)
