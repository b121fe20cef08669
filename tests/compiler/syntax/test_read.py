"""A tree of any text, with all in it that can be read."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.source import LARGEST, Source
from plutoc.syntax.parse import parse, read
from plutoc.syntax.recover import MOST_MISTAKES
from plutoc.syntax.tree import BadStatement, BlockDecl, File, FlowDecl, Statement
from tests.compiler.syntax.test_parse import SAMPLE

TOKENS = [match.span() for match in re.finditer(r"\w+|->|[^\w\s]|\n", SAMPLE)]


def read_text(text: str) -> tuple[File, list[str]]:
    """Read a text; the codes of what is found."""
    file, found = read(Source("app.pluto", text))
    return file, [d.code for d in found]


def statements(text: str) -> tuple[Statement, ...]:
    """Read what stands in an app's braces."""
    return read_text(f"pluto 1\napp demo {{\n{text}\n}}\n")[0].app.statements


def test_sound_source_gives_the_tree_that_parse_gives() -> None:
    """And nothing is found."""
    source = Source("app.pluto", SAMPLE)
    assert read(source) == (parse(source), ())


def test_statements_around_a_bad_one_are_there() -> None:
    """In their order, and the bad one between them."""
    one, bad, other = statements("a = K\nb = K(\nb -> c")
    assert isinstance(one, BlockDecl) and isinstance(other, FlowDecl)
    assert isinstance(bad, BadStatement)
    assert (bad.kind, bad.name and bad.name.text) == ("block", "b")


@pytest.mark.parametrize(
    ("text", "kind", "name"),
    [
        ("a = ", "block", "a"),
        ("a K", "block", "a"),
        ("a: K(x)", "block", "a"),
        ("category s(x: ) can y", "category", "s"),
        ("evaluator e x", "evaluator", "e"),
        ("version 1", "version", None),
        ("requires a", "requires", None),
        ("a -> -> b", "flow", None),
        ("when = K", "block", None),
        ("a b = K", "block", None),
        ("?", None, None),
    ],
)
def test_bad_statement_says_what_it_certainly_declares(
    text: str, kind: str | None, name: str | None
) -> None:
    (bad,) = statements(text)
    assert isinstance(bad, BadStatement)
    assert (bad.kind, bad.name and bad.name.text) == (kind, name)


def test_broken_first_line_of_an_app_costs_nothing_else() -> None:
    """Not its statements, and where it can be read not its name."""
    file, codes = read_text("pluto 1\nuse x\napp demo Title {\na = K\n}\n")
    assert codes == ["P0001"]
    assert (file.app.name.text, len(file.app.statements), len(file.uses)) == ("demo", 1, 1)
    assert [bad.kind for bad in file.bad] == ["app"]


@pytest.mark.parametrize(
    "text",
    [
        "",
        "\n",
        "pluto",
        "pluto 2",
        "pluto 2\napp a { } }",
        "}",
        "{",
        "app",
        "pluto 1\napp a {" + "a = K(x: " + "[" * 10_000,
        "x" * (LARGEST + 1),
        "pluto 1\napp a { b = K(x: " + "9" * 10_000 + ") }",
        "pluto 1\napp a {\n" + "loop {\n" * 500,
        "\ud800",
    ],
    ids=lambda text: repr(text[:20]),
)
def test_what_is_never_meant_has_a_tree_too(text: str) -> None:
    """An empty one at worst, and at least one finding."""
    file, codes = read_text(text)
    assert codes
    assert file.app.statements is not None


@pytest.mark.parametrize("text", ["pluto 2", "pluto 2\n", "pluto 2  # next", "pluto 2.1\nfleet x"])
def test_another_version_is_told_alone(text: str) -> None:
    """What else looks wrong may be right in that version."""
    assert read_text(text)[1] == ["P0008"]


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.sampled_from(TOKENS), st.text('"{}()[]->=,\n aK1#', max_size=4))
def test_every_edit_has_a_tree_with_places_in_the_text(place: tuple[int, int], by: str) -> None:
    """In order, and none in another."""
    start, end = place
    text = SAMPLE[:start] + by + SAMPLE[end:]
    file, _ = read_text(text)
    behind = 0
    for statement in file.app.statements:
        assert behind <= statement.span.start <= statement.span.end <= len(text)
        behind = statement.span.end


@pytest.mark.parametrize("before", ["", "ж"])
def test_every_control_character_is_refused(before: str) -> None:
    """Beside plain letters as beside others; but tabs and what ends a line."""
    for char in map(chr, range(0x100)):
        hidden = char not in "\t\n" and not char.isprintable() and char != "\u00a0"
        _, codes = read_text(f"pluto 1  # {before}{char} # {before}\napp a {{\n}}\n")
        assert ("P0004" in codes) == hidden, repr(char)


@pytest.mark.parametrize("seen", ["👩\u200d🌾", "❤\ufe0f", "1\ufe0f\u20e3", "می\u200cخواهم"])
def test_what_joins_signs_that_are_seen_is_allowed(seen: str) -> None:
    """Emoji and scripts need it."""
    assert read_text(f'pluto 1\napp a "{seen}" {{\n}}\n')[1] == []


def test_of_very_many_mistakes_the_first_are_told() -> None:
    """A file of nothing but mistakes is refused in seconds, and still has a tree."""
    text = "pluto 1\napp a {\n" + "x = = y\n" * (MOST_MISTAKES + 500) + "  b = Clock\n}\n"
    file, found = read(Source("app.pluto", text))
    assert len(found) == MOST_MISTAKES
    assert found[-1].span.start < len(text) - 500
    *bad, last = file.app.statements
    assert len(bad) == MOST_MISTAKES + 500
    assert isinstance(last, BlockDecl)
