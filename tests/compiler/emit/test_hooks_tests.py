"""What a developer finds to test hooks with: a test for each, which holds for any hooks.py."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from plutoc.compile import analyse, package_of
from plutoc.emit.hooks_tests import hooks_test
from plutoc.emit.package import emit
from plutoc.source import Source
from tests.compiler.emit.apps import ODD_NAMES, PARCELS, PLAIN
from tests.compiler.emit.plans import checked_of, plan_of
from tests.compiler.emit.test_hooks_file import BEFORE, BESIDE, LAST
from tests.kit.apps import EXAMPLES, compiled

WITH_HOOKS = sorted(path.parent.name for path in EXAMPLES.glob("*/hooks.py"))
PYTEST = ("-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/test_hooks.py")


def run(folder: Path, *command: str) -> str:
    """Run Python in a package's folder, and return what it printed."""
    done = subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": "src", "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def written(text: str, folder: Path) -> Path:
    """Write an app's package as it is first compiled, and return its folder."""
    checked, _ = analyse(Source("app.pluto", text))
    package = package_of(checked, source_name="app.pluto")
    for path, file in {**package.owned, **package.once}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(file, encoding="utf-8")
    return folder


def with_modifier(declaration: str, arrows: str) -> str:
    """Return a small app with a modifier `change`."""
    block = f"  {declaration}\n  changes = MissionModifier(hook: change)\n"
    head, _, _ = PLAIN.partition("  start ->")
    return f"{head}{block}{arrows}}}"


def with_evaluator(app: str) -> str:
    """Return a small app with an evaluator `judge_it`."""
    block = "  evaluator judge_it\n  judge = MissionEvaluator(hook: judge_it)\n"
    arrows = (
        "watch -> judge when COMPLETED\n  judge -> allocate when STANDBY\n  judge -> end otherwise"
    )
    return app.replace("\n\n  start", f"\n{block}\n  start").replace(
        "watch -> end otherwise", f"watch -> end when FAILED\n  {arrows}"
    )


MADE = {
    "odd": ODD_NAMES,
    "parcels": with_evaluator(PARCELS),
    "waiting": with_modifier("modifier change emits STANDBY, COMPLETED, FAILED", BESIDE),
    "standby": with_modifier("modifier change emits UNEXECUTED, STANDBY", BEFORE),
    "failed": with_modifier("modifier change emits FAILED", LAST),
}


@pytest.mark.parametrize("name", MADE)
def test_stubs_pass(name: str, tmp_path: Path) -> None:
    """Under any names, in every place that a hook can have."""
    folder = written(MADE[name], tmp_path)
    assert " passed" in run(folder, *PYTEST)


def test_they_are_strictly_typed_and_clean(tmp_path: Path) -> None:
    """Parameters are checked against those of the hooks, and results are known by type."""
    folder = written(ODD_NAMES, tmp_path)
    clean = run(folder, "-m", "ruff", "check", "--no-cache", "--isolated", ".")
    assert "All checks passed" in clean
    (folder / "tests/test_wrong.py").write_text(WRONG, encoding="utf-8")
    command = (
        "import os; from mypy import api; os.environ['MYPYPATH'] = 'src';"
        "print(api.run(['--strict', '--cache-dir', os.devnull, 'tests'])[0])"
    )
    said = run(folder, "-c", command)
    assert "Found 2 errors in 1 file" in said, said
    assert 'incompatible type "str"; expected "float"' in said, said
    assert 'expression has type "Verdict", variable has type "str"' in said, said


WRONG = """\
from odd_ import Drone, Mission, hooks
from odd_.testing import Kit, KitContext

def test_wrong(kit: Kit, drone: Drone, mission: Mission, context: KitContext) -> None:
    kit.call(hooks.print, drone, kit.trip(), context, list="x", kernel=0.5)
    status: str = kit.call(hooks.str, mission, kit.results(mission))
"""


@pytest.mark.parametrize("name", WITH_HOOKS)
def test_they_hold_for_hooks_that_are_written(name: str, tmp_path: Path) -> None:
    """A hooks.py beside the app becomes the package's, and the tests are none the wiser."""
    folder = compiled(name, tmp_path)
    assert " passed" in run(folder, *PYTEST)


def test_each_hook_has_a_test_in_declared_order() -> None:
    """Actions and other hooks of all kinds, as the app has them."""
    text = hooks_test(checked_of(ODD_NAMES))
    names = [line[9:].partition("(")[0] for line in text.splitlines() if line[:4] == "def "]
    assert names == ["float", "print", "builtins", "hooks", "str", "flow", "mission", "run"]


def test_a_test_is_called_for_as_the_app_calls_its_hook() -> None:
    """With defaults where there are any, and samples of the right kind elsewhere."""
    text = hooks_test(checked_of(ODD_NAMES))
    assert 'kit.trip("float", parameters={"int": 1.0, "str": "text", "object": 1})' in text
    assert 'hooks.float, drone, trip, context, int=1.0, str="text", bool=True, object=1' in text
    assert "hooks.flow, mission, context, list=180.0, func=1.5" in text


def test_without_hooks_there_is_no_kit() -> None:
    """Nothing of it is carried, nor a file written to test with it."""
    checked, _ = analyse(Source("app.pluto", PLAIN))
    package = package_of(checked, source_name="app.pluto")
    assert not [path for path in {**package.owned, **package.once} if "testing" in path]
    assert "tests/conftest.py" not in package.once


def test_left_over_hooks_keep_the_kit_that_their_tests_import() -> None:
    """The tests are the developer's, as hooks.py is: neither is written anew."""
    package = emit(plan_of(PLAIN), source_name="app.pluto", picture="", former={"old": "policy"})
    assert "src/plain/testing.py" in package.owned
    assert list(package.once) == ["src/plain/hooks.py"]


def test_no_module_of_the_package_imports_pytest(tmp_path: Path) -> None:
    """Only its tests do: it is no dependency, and the kit can be used with unittest."""
    folder = written(ODD_NAMES, tmp_path)
    code = "import sys, odd_.testing, odd_.__main__; print('pytest' in sys.modules)"
    assert run(folder, "-c", code) == "False\n"
    alone = "import sys, odd_.flow, odd_.hooks; print('odd_.testing' in sys.modules)"
    assert run(folder, "-c", alone) == "False\n"
