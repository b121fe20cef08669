"""Every mistake of a source is told, once."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.report.json import render_line
from plutoc.report.text import render
from plutoc.source import LARGEST, Source
from plutoc.syntax.layout import DEEPEST
from plutoc.syntax.parse import parse
from tests.compiler.syntax.test_parse import SAMPLE

TOKENS = [match.span() for match in re.finditer(r"\w+|->|[^\w\s]", SAMPLE)]


def mistakes(text: str) -> tuple[Diagnostic, ...]:
    """Parse a whole source and return what is wrong with it."""
    try:
        parse(Source("app.pluto", text))
    except Rejected as rejected:
        return rejected.diagnostics
    return ()


def in_app(text: str) -> list[str]:
    """Parse what stands in an app's braces; the codes, each with its line there."""
    found = mistakes(f"pluto 1\napp demo {{\n{text}\n}}\n")
    return [f"{d.code} {d.source.position(d.span.start)[0] - 2}" for d in found]


def test_mistakes_before_the_app() -> None:
    """A broken line does not hide the app's own mistakes."""
    found = mistakes("pluto 1\nuse 3\nuse b\nap demo {\n a b\n}\n")
    assert [d.code for d in found] == ["P0001", "P0001", "P0001"]
    assert found[1].help == "did you mean `app`?"


def test_fix_of_a_missing_header() -> None:
    """Inserted where there is none, put right where it is wrong."""
    for text, mended in (("app a {}", "pluto 1\napp a {}"), ("Pluto 1\napp a {}",) * 2):
        (found,) = mistakes(text)
        assert found.fix
        span = found.fix.span
        now = text[: span.start] + found.fix.text + text[span.end :]
        assert now.lower() == mended.lower()
        assert not mistakes(now)


def test_nothing_at_all() -> None:
    """An empty file lacks its app."""
    assert [d.code for d in mistakes("")] == ["P0015"]
    assert [d.code for d in mistakes("\n# nothing\n")] == ["P0015"]


def test_limits() -> None:
    """Beyond them, one error and no more."""
    assert [d.code for d in mistakes(SAMPLE + "#" * LARGEST)] == ["P0006"]
    assert mistakes(SAMPLE + "#" * (LARGEST - len(SAMPLE.encode()))) == ()
    deep = "[" * DEEPEST + "]" * DEEPEST
    assert in_app(f"a = K(x: {deep})") == ["P0007 1"]
    assert in_app(f"a = K(x: {deep[1:-1]})") == []
    assert in_app("a = K(x: 123456789012345)") == []
    assert in_app("a = K(x: 1234567890123456)") == ["P0012 1"]


@pytest.mark.parametrize(
    "char",
    "\x00\x1b\x7f\u00ad\u034f\u061c\u200b\u202e\u2060\u2066\u2028\ufe0f\ufeff\U000e0041",
)
def test_hidden_characters_are_refused_everywhere(char: str) -> None:
    """In a text, in a comment, and outside."""
    assert in_app(f'a = K(x: "a{char}b")') == ["P0004 1"]
    assert in_app(f"a = K  # a{char}b") == ["P0004 1"]
    assert in_app(f"a {char}= K") == ["P0003 1"]


@settings(max_examples=150, deadline=None)
@given(st.text(max_size=60), st.integers(0, len(SAMPLE)))
def test_any_text_gives_diagnostics_and_no_crash(text: str, at: int) -> None:
    """With places inside the source, in order, that every report can show."""
    found = mistakes(SAMPLE[:at] + text + SAMPLE[at:])
    for diagnostic in found:
        span = diagnostic.span
        assert 0 <= span.start <= span.end <= len(diagnostic.source.text)
        assert "\n" not in render_line(diagnostic)
    for one, other in pairwise(found):
        assert one.span.start <= other.span.start
    render(found, colour=True)


@settings(max_examples=250, deadline=None)
@given(st.sampled_from(TOKENS), st.sampled_from(["", "x", ",", "->", "("]))
def test_one_wrong_token_is_at_most_two_diagnostics(place: tuple[int, int], text: str) -> None:
    """Mistakes do not cascade: a token replaced, or left out, is told once, or twice at worst."""
    start, end = place
    assert len(mistakes(SAMPLE[:start] + text + SAMPLE[end:])) <= 2
