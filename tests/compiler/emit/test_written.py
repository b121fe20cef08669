"""What is written of an app: its flow, and the stubs and tests of its hooks, word by word.

`flows.txt` shows the flow, optimised and plain; `stubs.txt` what a developer finds to fill in and to test with.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.emit.flow_file import flow_file
from plutoc.emit.hooks_file import hooks_file
from plutoc.emit.hooks_tests import hooks_test
from plutoc.emit.model_file import model_file
from plutoc.emit.render import formatted
from tests.compiler.emit.plans import plan_of
from tests.kit.sections import Section, compare, params

HERE = Path(__file__).parent


@pytest.mark.parametrize("case", params(HERE / "flows.txt"))
def test_a_flow_is_written(case: Section, update: bool) -> None:
    plans = {
        "optimised": plan_of(case.given),
        "plain": plan_of(case.given, optimise=False),
    }
    shown = [f"-- {name}\n{formatted(flow_file(plan))}" for name, plan in plans.items()]
    compare(case, "\n".join(shown), update)


@pytest.mark.parametrize("case", params(HERE / "stubs.txt"))
def test_hooks_and_their_tests_are_written(case: Section, update: bool) -> None:
    """In the order in which the app declares them; quantities arrive in SI units."""
    plan = plan_of(case.given)
    files = {
        "hooks.py": hooks_file(plan.checked),
        "test_hooks.py": hooks_test(plan.checked),
        "model.py": model_file(plan.checked.graph),
    }
    if "change" in case.given:  # of one hook nothing else is worth reading twice
        del files["test_hooks.py"], files["model.py"]
    shown = [f"-- {name}\n{formatted(text)}" for name, text in files.items()]
    compare(case, "\n".join(shown), update)
