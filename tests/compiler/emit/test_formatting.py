"""Generated Python comes out as Black writes it, and holds any text as it was meant."""

from __future__ import annotations

import ast

import black
import hypothesis.strategies as st
import pytest
from black.mode import TargetVersion
from hypothesis import given

from plutoc.emit.python import LINE_LENGTH, literal
from plutoc.emit.render import formatted
from tests.compiler.emit.texts import APPS, modules_of

MODE = black.Mode(line_length=LINE_LENGTH, target_versions={TargetVersion.PY311})


@pytest.mark.parametrize("text", APPS, ids=range(len(APPS)))
def test_a_package_is_as_black_writes_it(text: str) -> None:
    """Every module of the app, and its tests: Black would change nothing."""
    modules = modules_of(text)
    assert {path.rpartition("/")[2] for path in modules} > {"flow.py", "model.py", "test_flow.py"}
    for path, module in modules.items():
        assert black.format_str(module, mode=MODE) == module, path


@given(st.text())
def test_a_text_is_written_in_ascii_and_read_back(text: str) -> None:
    """Any that a user has written."""
    module = formatted(f"x = {literal(text)}")
    assert module.isascii()
    (assignment,) = ast.parse(module).body
    assert isinstance(assignment, ast.Assign)
    assert ast.literal_eval(assignment.value) == text
