"""The stubs that a developer finds are right at once; how they read is in `stubs.txt`."""

from __future__ import annotations

import pytest

from plutoc.compile import analyse, check_hooks, package_of
from plutoc.emit.package import emit
from plutoc.source import Source
from tests.compiler.emit.apps import PLAIN
from tests.compiler.emit.plans import plan_of
from tests.compiler.emit.texts import APPS

RAISED_BY_NONE = "P3023"
"""Said of an event until a hook raises it."""
SMALL = [app for app in APPS if len(app) < 5_000]


@pytest.mark.parametrize("app", SMALL, ids=range(len(SMALL)))
def test_nothing_is_to_be_said_of_stubs(app: str) -> None:
    """So who compiles again, with nothing written yet, is told what was told before."""
    checked, _ = analyse(Source("app.pluto", app))
    hooks = package_of(checked, source_name="app.pluto").once[f"src/{checked.graph.name}/hooks.py"]
    found = check_hooks(checked, Source("hooks.py", hooks))
    assert [one for one in found if one.code != RAISED_BY_NONE] == []


def test_without_hooks_there_is_no_kit() -> None:
    """Nothing of it is carried, nor a file written to test with it."""
    package = emit(plan_of(PLAIN), source_name="app.pluto", picture="", graph_data="")
    assert not [path for path in {**package.owned, **package.once} if "testing" in path]
    assert list(package.once) == ["src/plain/hooks.py"]


def test_left_over_hooks_keep_the_kit_that_their_tests_import() -> None:
    """The tests are the developer's, as hooks.py is: neither is written anew."""
    package = emit(
        plan_of(PLAIN), source_name="app.pluto", picture="", graph_data="", former={"old": "policy"}
    )
    assert "src/plain/testing.py" in package.owned
    assert list(package.once) == ["src/plain/hooks.py"]
