"""Reading a hooks.py without running it."""

from __future__ import annotations

import ast

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from plutoc.hooks.module import arg_span, name_span, read, yields
from plutoc.hooks.python import Unreadable
from plutoc.source import Source


def defined(text: str) -> list[str]:
    """Return the names that a module defines."""
    return sorted(read(Source("hooks.py", text)).defined)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("def a(): ...", ["a"]),
        ("async def a(): ...", ["a"]),
        ("a = b = lambda: 1", ["a", "b"]),
        ("a, (b, *c) = 1, (2, 3)", ["a", "b", "c"]),
        ("a: int = 1", ["a"]),
        ("a: int", []),
        ("import a.b, c as d", ["a", "d"]),
        ("from a import b, c as d", ["b", "d"]),
        ("if x:\n  def a(): ...\nelse:\n  def b(): ...", ["a", "b"]),
        ("try:\n  from a import b\nexcept E:\n  def c(): ...\nfinally:\n  d = 1", ["b", "c", "d"]),
        ("match x:\n  case 1:\n    def a(): ...", ["a"]),
        ("with x:\n  def a(): ...", ["a"]),
        ("def a():\n  def b(): ...\nclass c:\n  def d(self): ...", ["a", "c"]),
    ],
)
def test_names_of_the_top_level_are_found(text: str, names: list[str]) -> None:
    """Also those that an `if` or a `try` may skip; not those of inner functions."""
    assert defined(text) == names


@pytest.mark.parametrize(
    ("body", "does"),
    [
        ("return 1", False),
        ("yield 1", True),
        ("x = [(yield from y)]", True),
        ("def inner(): yield 1", False),
        ("return (lambda: (yield))", False),
        ("if x:\n    yield", True),
    ],
)
def test_a_generator_is_told_from_a_function(body: str, does: bool) -> None:
    """A `yield` of an inner function does not count."""
    function = ast.parse(f"def a():\n  {body}").body[0]
    assert isinstance(function, ast.FunctionDef)
    assert yields(function) is does


def test_places_are_counted_in_characters() -> None:
    """Python counts bytes."""
    source = Source("hooks.py", 'é = "→"; \ndef a(x: "ü", größe=1): ...\n')
    function = read(source).defined["a"]
    assert isinstance(function, ast.FunctionDef)
    assert source.quote(name_span(source, function)) == "a"
    assert [source.quote(arg_span(source, arg)) for arg in function.args.args] == ["x", "größe"]


def test_a_name_behind_a_line_continuation_has_a_place() -> None:
    """That of its `def`."""
    source = Source("hooks.py", "def \\\n  a(): ...\n")
    function = read(source).defined["a"]
    assert isinstance(function, ast.FunctionDef)
    assert source.position(name_span(source, function).start) == (1, 1)


@given(st.text(alphabet=st.sampled_from("adefsync ():\\\n\"'#=,*\t\x00\ufeffé\f")))
@example("a" * 3 + "(" * 300)
@example("x = " + "-" * 20_000 + "1")
@example("\x00")
@example('"\\d"')
@example("def a(")
@example("'''")
def test_anything_is_read_or_refused_with_a_place_in_it(text: str) -> None:
    """Python's own errors, odd places included, never come through."""
    source = Source("hooks.py", text)
    try:
        read(source)
    except Unreadable as error:
        assert error.why
        if error.span is not None:
            assert 0 <= error.span.start <= len(text)
            source.position(error.span.start)
