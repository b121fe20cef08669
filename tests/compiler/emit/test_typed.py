"""What an app declares of fields, parameters and results, a type checker knows of its package."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from plutoc.emit.flow_file import flow_file
from plutoc.emit.model_file import model_file
from tests.compiler.emit.apps import ODD_NAMES, PLAIN, TYPED
from tests.compiler.emit.plans import plan_of
from tests.compiler.emit.test_package import package_of, run, write

MYPY = (
    "import os, sys; from mypy import api; os.environ['MYPYPATH'] = 'src';"
    "out, err, code = api.run(['--strict', '--cache-dir', os.devnull, 'src', 'tests']);"
    "print(out, err)"
)
WRONG = """\
from __future__ import annotations

from typed_ import Mission, Result, Results, Trip, Verdict, hooks
from typed_.testing import Kit


def names(mission: Mission, trip: Trip, results: Results) -> Verdict:
    reveal_type(mission.str)
    reveal_type(mission.float)
    reveal_type(mission.model)
    reveal_type(trip.bool)
    reveal_type(trip.warmth)
    reveal_type(results.new[0].value)
    for _, _, _, _, value in results.all:
        reveal_type(value)
    return Verdict(redo=[trip], add=[again()], log=["a", "b"])


def again() -> Trip:
    return Trip(name="a", action="count", target=(1, 2, 3), bool=True, builtins=1.0, warmth=2.0)


def number(result: Result) -> float:
    return result.value


def tested(kit: Kit, mission: Mission) -> None:
    reveal_type(kit.results(mission))
    reveal_type(kit.call(hooks.count, kit.drone(), kit.trip("count"), kit.context()))
    kit.call(hooks.str, mission, kit.results(mission), least="2", share=0.5)
    Trip(name="a", action="count", target=(1, 2, 3), bool=True, builtins=1.0)
    Mission(name="a", trips=[], str="x", model="y")
    mission.float = "2 m"
"""
SAYS = (
    '10: note: Revealed type is "str"',
    '11: note: Revealed type is "float"',
    '12: note: Revealed type is "int"',
    '13: note: Revealed type is "bool"',
    '14: note: Revealed type is "float"',
    *(f'{line}: note: Revealed type is "float | typed_._runtime.domain.model.Photo | int | str | None"' for line in (15, 17)),
    '26: error: Incompatible return value type',
    '31: note: Revealed type is "int"',
    '32: error: Argument "least" to "call" of "AppKit" has incompatible type "str"; expected "int"',
    '33: error: Missing named argument "warmth" for "Trip"',
    '34: error: Argument "model" to "Mission" has incompatible type "str"; expected "int"',
    '35: error: Incompatible types in assignment',
)  # fmt: skip


def test_they_are_typed_through_and_through(tmp_path: Path) -> None:
    """The package is clean for mypy --strict; and what uses it wrongly is told."""
    folder = write(package_of(TYPED), tmp_path)
    assert "no issues found" in run(folder, "-c", MYPY)
    (folder / "tests/wrong.py").write_text(WRONG, encoding="utf-8")
    said = run(folder, "-c", MYPY).replace("builtins.", "")
    for line in SAYS:
        assert f"tests/wrong.py:{_shifted(line)}" in said, said
    assert len(re.findall(r": error:", said)) == 6, said


def _shifted(line: str) -> str:
    number, _, rest = line.partition(":")
    return f"{int(number) - 2}:{rest}"


def test_results_are_typed_only_where_all_actions_say_what_they_give() -> None:
    for text in (PLAIN, ODD_NAMES, TYPED.replace("-> mass", "once")):
        assert "Result = model.Result[Mission, Trip]" in model_file(plan_of(text).checked.graph)


@pytest.mark.parametrize("text", [PLAIN, ODD_NAMES])
def test_a_package_carries_nothing_of_what_it_does_not_use(text: str) -> None:
    """Neither fields of its own, nor typed actions, nor typed results."""
    files = "".join(package_of(text).owned)
    assert not re.search(r"own_fields|typed_action|typed_results", files)


def test_an_evaluator_that_missions_choose_has_its_defaults() -> None:
    """Beside its block's own settings."""
    text = flow_file(plan_of(TYPED))
    assert "'str': partial(hooks.str, least=2, share=0.2)" in text
    assert "'int': partial(hooks.int, float=0.5)" in text
    assert "hook=partial(hooks.int, float=1.5), own='int', evaluator=" in text
