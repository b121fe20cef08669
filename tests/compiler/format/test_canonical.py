"""What the canonical form looks like."""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path
from textwrap import dedent, indent

import pytest

from plutoc.diagnostic import Rejected
from tests.compiler.format.promises import formatted
from tests.paths import ROOT

LONG = "a_name_that_is_rather_long"


def body(text: str) -> str:
    """Format what stands in an app's braces."""
    whole = formatted(f"pluto 1\napp demo {{\n{text}\n}}\n")
    assert whole.startswith("pluto 1\n\napp demo {\n") and whole.endswith("}\n")
    return dedent(whole.removeprefix("pluto 1\n\napp demo {\n").removesuffix("}\n"))


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("a=K", "a = K"),
        ("a = b . K ( )", "a = b.K()"),
        ("a = K(x:5min,y : 40%)", "a = K(x: 5 min, y: 40 %)"),
        ("a = K(x: -0.50\t\tm/s)", "a = K(x: -0.50 m/s)"),
        ("a = K(x: 007, y: 1.0)", "a = K(x: 007, y: 1.0)"),
        ("a = K(x: [[1,2,],[ ]],)", "a = K(x: [[1, 2], []])"),
        ('a = K(x: "b,c  :d")', 'a = K(x: "b,c  :d")'),
        ("a->b  ->[c,d,]->  e", "a -> b -> [c, d] -> e"),
        ("a -> b when X,Y,", "a -> b when X, Y"),
        ("[a,b]->end   otherwise", "[a, b] -> end otherwise"),
        ("category  c(payload:5g)can x,y,", "category c(payload: 5 g) can x, y"),
        ("action a(b:mass=5g)once", "action a(b: mass = 5 g) once"),
        ("action a ( ) ->float", "action a() -> float"),
        ("action a(b:mass)once->  float", "action a(b: mass) -> float once"),
        ("action a safe->photo  # why", "action a -> photo safe  # why"),
        ("action a once # why\n->int  # what", "action a  # why\n  -> int once  # what"),
        ("evaluator e(x:int=2,)", "evaluator e(x: int = 2)"),
        ("mission  has a:text,b : time=5min ,", "mission has a: text, b: time = 5 min"),
        ("trip has\ta: text", "trip has a: text"),
        ("mission->trip  ->has", "mission -> trip -> has"),
        ("modifier m()emits A,B,writes c,", "modifier m() emits A, B writes c"),
        ('version"1.2.0"', 'version "1.2.0"'),
        ('requires  "a,b"  ,"c" ,', 'requires "a,b", "c"'),
        ("version=K", "version = K"),
        ("a\n-> b\n\n->c", "a -> b -> c"),
        ("a = K(\n\nx: 1\n,y: 2)", "a = K(x: 1, y: 2)"),
    ],
)
def test_a_statement_has_one_form(text: str, form: str) -> None:
    """Blanks where they belong; numbers, units and texts as they were written."""
    assert body(text) == form + "\n"


@pytest.mark.parametrize(
    "form",
    [
        f"a = K(\n  {LONG}_1: 1,\n  {LONG}_2: [1, 2],\n  {LONG}_3: 3,\n)",
        f"category c(\n  {LONG}_1: 1,\n  {LONG}_2: 2,\n) can {LONG}_1, {LONG}_2, {LONG}_3",
        f"{LONG}_1\n  -> {LONG}_2\n  -> [{LONG}_3, {LONG}_4]\n  -> {LONG}_5 when STANDBY",
        f"a\n  -> [\n    {LONG}_1,\n    {LONG}_2,\n    {LONG}_3,\n    {LONG}_4,\n  ]\n  -> b",
        f"category c can {LONG}_1, {LONG}_2, {LONG}_3, {LONG}_4, {LONG}_5",
        f'a = K(\n  x: "{LONG * 5}",\n)',
        f'requires "{LONG}>=1", "{LONG}_2[extra]>=2.32,<3", "{LONG}_3", "{LONG}_4"  # behind it',
    ],
)
def test_what_is_too_long_is_broken_where_it_can_be(form: str) -> None:
    """An element a line, with a comma; arrows at the beginnings of lines; nothing elsewhere."""
    in_one_line = re.sub(r",\n *([)\]])", r"\1", re.sub(r"([(\[])\n *", r"\1", form))
    in_one_line = re.sub(r"\n *", " ", in_one_line)
    in_one_line = re.sub(r", *([)\]])", r"\1", in_one_line)
    assert body(in_one_line) == form + "\n"


def test_a_statement_may_reach_the_last_column_and_not_beyond() -> None:
    """A hundred, with the indentation; a comment behind it does not count."""
    fits = f"a = K({'x' * 85}: 1234)"
    assert len("  " + fits) == 100
    assert body(fits + "  # a comment") == fits + "  # a comment\n"
    assert body(fits.replace("234", "2345")).startswith("a = K(\n  x")


@pytest.mark.parametrize(
    "form",
    [
        "a = K  # behind",
        "# above\na = K",
        "# one\n\n# two\n\na = K\n# below",
        "a = K(  # behind the bracket\n  x: 1,\n)",
        "a = K(\n  # above the first\n  x: 1,  # behind\n  # below\n)",
        "a = K(  # nothing else\n)",
        "a = K(\n  # nothing else\n)",
        "a = K(\n  x:  # in the middle\n    # of an element\n    [1, 2],\n)",
        "a = K(\n  x: [\n    1,  # in a list\n    2,\n  ],\n)",
        "action a(\n  b:  # before a type\n    mass\n    = 5 g,\n)",
        "a\n  -> b  # behind\n  # above\n  -> c  # at the end",
        "[\n  a,  # first\n  b,\n]\n  -> c",
    ],
)
def test_comments_stay_where_they_are(form: str) -> None:
    """Alone on their lines, or behind what they stood behind."""
    assert body(form) == form + "\n"


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("a = K(x: 1 # why\n, y: 2)", "a = K(\n  x: 1,  # why\n  y: 2,\n)"),
        ("a = K(x: 1 # why\n, # what\ny: 2)", "a = K(\n  x: 1,  # why\n  # what\n  y: 2,\n)"),
        ("a = K(x: 1\n# why\n, # what\ny: 2)", "a = K(\n  x: 1,\n  # why\n  # what\n  y: 2,\n)"),
        ("a = K(x: 1,# why\n)", "a = K(\n  x: 1,  # why\n)"),
        ("category c can a, # why", "category c can a  # why"),
        ("a #why\t\n->b", "a  #why\n  -> b"),
        ("\n\n\na = K\n\n\n\nb = K\n\n", "a = K\n\nb = K"),
        ("a = K(\n\n# why\n\n# what\nx: 1)", "a = K(\n  # why\n  # what\n  x: 1,\n)"),
    ],
)
def test_comments_and_blank_lines_have_one_form_too(text: str, form: str) -> None:
    """A comma goes before a comment; blank lines stay between statements, one at a time."""
    assert body(text) == form + "\n"


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("pluto 1\napp a{}", "pluto 1\n\napp a {\n}\n"),
        ('pluto 1\napp a"T"{b->c}', 'pluto 1\n\napp a "T" {\n  b -> c\n}\n'),
        ("\ufeffpluto 1\r\n\r\n\r\napp a {\r\n}\r\n", "pluto 1\n\napp a {\n}\n"),
        ("\n# x\n\n\npluto 1\napp a {}", "# x\n\npluto 1\n\napp a {\n}\n"),
        ("pluto 1\nuse b\nuse c as d\napp a {}", "pluto 1\nuse b\nuse c as d\n\napp a {\n}\n"),
        ("pluto 1\n\nuse b\napp a {}", "pluto 1\n\nuse b\n\napp a {\n}\n"),
        ("pluto 1 # x\n# y\napp a {}", "pluto 1  # x\n\n# y\napp a {\n}\n"),
        ("pluto 1\n# y\n\napp a {}", "pluto 1\n# y\n\napp a {\n}\n"),
        ("pluto 1\napp a { # x\n\n# y\n\n} # z", "pluto 1\n\napp a {  # x\n  # y\n}  # z\n"),
        ("pluto 1\napp a {b -> c # x\n}", "pluto 1\n\napp a {\n  b -> c  # x\n}\n"),
        ("pluto 1\napp a {}\n\n\n# x\n# y", "pluto 1\n\napp a {\n}\n\n# x\n# y\n"),
    ],
)
def test_a_file_has_one_form(text: str, form: str) -> None:
    """The app is set apart, no blank line stands at its braces, one newline ends the file."""
    assert formatted(text) == form
    assert formatted(form) == form


def test_mistakes_of_syntax_are_all_reported() -> None:
    """As by `plutoc check`."""
    with pytest.raises(Rejected) as rejected:
        formatted("pluto 1\napp a {\n  b = = K\n  c -> d e\n}\n")
    assert len(rejected.value.diagnostics) == 2


def test_the_starter_is_in_canonical_form() -> None:
    """What `plutoc new` writes needs no `plutoc fmt`."""
    starter = files("plutoc.cli").joinpath("starter", "app.pluto").read_text("utf-8")
    assert formatted(starter) == starter


PAGES = [ROOT / "README.md", ROOT / "docs/language.md", *sorted(ROOT.glob("docs/tutorial/*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_what_the_pages_show_is_in_canonical_form(page: Path) -> None:
    """Whole apps, and pieces of them."""
    shown = re.findall(r"^```(\w*)\n(.*?)^```$", page.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    for language, text in shown:
        if text.startswith("pluto 1\n"):
            assert formatted(text) == text
        elif language == "pluto":
            whole = f"pluto 1\n\napp page {{\n{indent(dedent(text), '  ')}}}\n"
            assert formatted(whole) == whole
