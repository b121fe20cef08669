"""The stubs that a developer finds: right at once, and easy to see through."""

from __future__ import annotations

import ast

import pytest

from plutoc.compile import analyse, check_hooks, package_of
from plutoc.emit.hooks_file import hooks_file, stub
from plutoc.source import Source
from tests.compiler.emit.apps import ODD_NAMES, PLAIN
from tests.compiler.emit.plans import checked_of
from tests.compiler.emit.texts import APPS


def with_modifier(declaration: str, arrows: str) -> str:
    """Return the stub of a modifier `change`, used in a small app."""
    block = f"  {declaration}\n  changes = MissionModifier(hook: change)\n"
    head, _, _ = PLAIN.partition("  start ->")
    return stub(checked_of(f"{head}{block}{arrows}}}"), "change")


BESIDE = """\
  first = GateFIFO
  start -> create -> allocate -> launch -> [watch, changes] -> first
  first -> allocate when STANDBY
  first -> end otherwise
"""
BEFORE = """\
  start -> create -> allocate -> changes -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end otherwise
"""
BETWEEN = """\
  start -> create -> allocate -> launch -> changes -> watch
  watch -> allocate when STANDBY
  watch -> end otherwise
"""
BEHIND = """\
  start -> create -> allocate -> launch -> watch
  watch -> changes when STANDBY, FAILED
  changes -> allocate when STANDBY
  changes -> end otherwise
  watch -> end otherwise
"""
LAST = """\
  start -> create -> allocate -> launch -> watch -> changes -> end
"""


def test_modifier_beside_a_monitor_waits_for_the_trip() -> None:
    """Then the mission's own status is one that it declares."""
    written = with_modifier("modifier change emits STANDBY, COMPLETED, FAILED", BESIDE)
    assert written == (
        "async def change(mission: Mission, context: Context) -> Status:\n"
        '    """Say with which status the mission goes on: STANDBY, COMPLETED or FAILED."""\n'
        '    context.log("change does nothing yet: write it in hooks.py")\n'
        "    await context.trip_ended(mission.current)\n"
        "    return mission.status\n"
    )


@pytest.mark.parametrize(
    ("emits", "arrows", "returned"),
    [
        ("UNEXECUTED, STANDBY", BEFORE, "mission.status"),
        ("RUNNING", BETWEEN, "mission.status"),
        ("STANDBY, FAILED", BEHIND, "mission.status"),
        ("STANDBY", BEHIND, "Status.STANDBY"),
        ("FAILED", LAST, "Status.FAILED"),
    ],
)
def test_other_modifiers_return_at_once(emits: str, arrows: str, returned: str) -> None:
    """What they return is declared for each status that a mission comes with."""
    written = with_modifier(f"modifier change emits {emits}", arrows)
    assert "await" not in written
    assert written.endswith(f"    return {returned}\n")


def test_modifier_that_declares_too_little_falls_back() -> None:
    """Where the mission can stand otherwise, the stub fails it rather than lie."""
    written = with_modifier("modifier change emits STANDBY, FAILED", BESIDE)
    assert written.endswith(
        "    return mission.status if mission.status in (Status.STANDBY, Status.FAILED)"
        " else Status.FAILED\n"
    )


def test_modifier_without_statuses_returns_nothing() -> None:
    """Its mission's status stays."""
    assert "return" not in with_modifier("modifier change", BEFORE)


def test_parameters_say_their_units() -> None:
    """Quantities arrive in SI units, and the stub says in which."""
    written = stub(checked_of(ODD_NAMES), "print")
    assert "`list` is in kilograms, `kernel` is a share from 0 to 1." in written


def test_stubs_stand_in_declared_order() -> None:
    """Actions and other hooks of all kinds, as the app has them."""
    tree = ast.parse(hooks_file(checked_of(ODD_NAMES)))
    functions = (ast.AsyncFunctionDef, ast.FunctionDef)
    names = [node.name for node in tree.body if isinstance(node, functions)]
    assert names == ["float", "print", "builtins", "hooks", "str", "flow", "mission", "run"]


def test_hidden_types_are_spelled_out() -> None:
    """A hook named like a type of Python's does not change what the others' annotations mean."""
    written = hooks_file(checked_of(ODD_NAMES))
    assert "import builtins as _builtins\n" in written
    assert "list: _builtins.float, kernel: _builtins.float" in written
    assert "bool: bool" in written


def test_only_what_is_used_is_imported() -> None:
    """An app without hooks imports nothing."""
    assert "import" not in hooks_file(checked_of(PLAIN))


def test_fields_of_the_app_are_named() -> None:
    """The first lines say what there is, blocks' fields included."""
    written = hooks_file(checked_of(ODD_NAMES))
    assert "`attempts`, `at`, `every`, `evaluator`." in written
    assert "`priority`" not in hooks_file(checked_of(PLAIN))


@pytest.mark.parametrize("app", APPS, ids=range(len(APPS)))
def test_nothing_is_to_be_said_of_stubs(app: str) -> None:
    """So who compiles again, with nothing written yet, is told what was told before."""
    checked, _ = analyse(Source("app.pluto", app))
    hooks = package_of(checked, source_name="app.pluto").once[f"src/{checked.graph.name}/hooks.py"]
    assert check_hooks(checked, Source("hooks.py", hooks)) == ()
