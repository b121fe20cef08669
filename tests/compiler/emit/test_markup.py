"""Free text stays text."""

from __future__ import annotations

import ast
import tomllib

import hypothesis.strategies as st
from hypothesis import given, settings

from plutoc.emit.markup import fence, header, markdown, toml_text
from plutoc.emit.python import literal
from plutoc.emit.render import formatted

WHOLE = st.text(st.characters(exclude_categories=["Cs"]))


@given(WHOLE)
def test_toml_gives_every_text_back(text: str) -> None:
    """Any text is ASCII in the file and itself when read."""
    assert toml_text(text).isascii()
    assert tomllib.loads(f"a = {toml_text(text)}") == {"a": text}


@settings(max_examples=30)
@given(st.text())
def test_a_text_is_written_in_ascii_and_read_back_in_python(text: str) -> None:
    """Any that a user has written."""
    module = formatted(f"x = {literal(text)}")
    assert module.isascii()
    (assignment,) = ast.parse(module).body
    assert isinstance(assignment, ast.Assign)
    assert ast.literal_eval(assignment.value) == text


@given(st.text())
def test_markdown_is_one_line_without_marks(text: str) -> None:
    """Nothing of it can begin a tag, a link, a table cell or code."""
    written = markdown(text)
    assert len(written.splitlines()) <= 1
    for mark in "`<[|*":
        assert f"\\{mark}" in written or mark not in text


@given(st.text("`\na"))
def test_nothing_closes_a_fence_early(text: str) -> None:
    """The fence is longer than any run of backticks in the text."""
    assert fence(text) not in text


@given(st.text())
def test_header_is_one_line_and_no_encoding(name: str) -> None:
    """Only a plain file name gets into it."""
    written = header(name)
    assert "\n" not in written and "coding:" not in written and "coding=" not in written
    assert written.isascii() and written.endswith(". DO NOT EDIT.")
