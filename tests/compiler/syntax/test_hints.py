"""Who writes as in another language is told how it is written here."""

from __future__ import annotations

import pytest

from plutoc.edits import applied
from plutoc.source import Source
from tests.compiler.syntax.test_mistakes import mistakes

SAID = [
    ("category a(speed: 0,8 m/s) can x", "a number has a point instead of the comma: `0.8 m/s`"),
    ("category a(speed: .8 m/s) can x", "a number has a digit before its point: `0.8 m/s`"),
    ("category a(speed: 1. m/s) can x", "a number has a digit behind its point: `1.0`"),
    ("category a(speed: 3 km / h) can x", "a unit has no space in it: `3 km/h`"),
    ("category a(speed: 1/2 m/s) can x", "a fraction is written with a point: `0.5`"),
    ("a = K(x: 5 min 30 s)", "a value is one number with one unit"),
    ("a = K(nearest)", "a value stands behind the name of its parameter: `NAME: nearest`"),
    ("a = K(x: 1, nearest)", "a value stands behind the name of its parameter: `NAME: nearest`"),
    ("action a(dose = 50 mg)", "a parameter has a type: `dose: TYPE = 50 mg`"),
    ("action a(dose)", "a parameter has a type: `dose: TYPE`"),
    ("a -> b when (FAILED)", "the names behind `when` stand there without brackets"),
    ("category a can [x, y]", "the names behind `can` stand there without brackets"),
    (
        "a -> b when FAILED or STANDBY",
        "a list has commas: write `,` instead of `or`",
    ),
    (
        "a -> b when not FAILED",
        "name the statuses that are meant, or write `otherwise` for all the others",
    ),
    (
        "a -> b when status == FAILED",
        "only the names of statuses stand here, as in `when COMPLETED`",
    ),
    ("a -> b when FAILED, a -> c", "a guard ends its statement: begin the next one on a new line"),
    ("a -> b FAILED", "write `when FAILED`"),
    ("a -> b: FAILED", "write `when FAILED`"),
    ("a -> b [FAILED]", "write `when FAILED`"),
    ("a -FAILED-> b", "write `when FAILED` at the end of the statement"),
    ("a when FAILED -> b", "a guard stands at the end: `a -> BLOCK when STATUS`"),
    ("a <- b", "arrows point to the right: write `A -> B` instead of `B <- A`"),
    ("a -> (b, c) -> d", "branches stand in `[` and `]`"),
    ("a -> {b, c} -> d", "branches stand in `[` and `]`"),
    (
        "a -> [b -> c, d] -> e",
        "only names stand in brackets: draw a chain of blocks in a statement of its own",
    ),
    ("a -> [b, c -> e", "write `]` before it"),
    ("a -> [b, [c, d]] -> e", "name all branches in one pair of brackets"),
    ("a -> b = K -> c", "declare it in a statement of its own: `b = KIND`"),
    ("a = new Kind()", "remove `new`"),
    ("let a = K", "remove `let`"),
    ("Kind a", "to declare a block, write `a = Kind`"),
    ("a b = K", "a name has no space in it: for instance `a_b`"),
    ("a b -> c", "write `->` before it"),
    ("a-b = K", "a name has no `-`: for instance `a_b`; an arrow is written `->`"),
    ("a\U0001f681 = K", "names have only the letters a to z, digits and `_`"),
    ("a = K  b = L", "every statement begins on a line of its own"),
    ("category a x, y", "write `can` before it"),
    ("evaluator a, b", "write `evaluator` on a line of its own for each of them"),
    ("policy a()", "remove the brackets: what a policy gets is clear from its being one"),
    ("evaluator a -> b", "only an action declares what it gives"),
    ("action a: float", "write `->` before the type of what it gives"),
    ("mission a: text", "write `has` before it"),
    ("mission have a: text", "did you mean `has`?"),
    ("missions has a: text", "did you mean `mission`?"),
    ("trip has a", "a field has a type: `a: TYPE`"),
    ("trip has a, b: int", "a field has a type: `a: TYPE`"),
    ("trip has a: int, b = 3", "a field has a type: `b: TYPE = 3`"),
    ("mission has (a: text)", "the fields behind `has` stand there without brackets"),
    (
        "mission has a: int,\n  b: int",
        "a list ends with its line: go on in the line above, behind the comma",
    ),
    ("version 1.2.0", 'it stands in quotes, as in `version "1.2.0"`'),
    ("version", 'it stands in quotes, as in `version "1.2.0"`'),
    ('version: "1"', 'it stands in quotes, as in `version "1.2.0"`'),
    ('version = "1"', 'write it without the `=`: `version "1.2.0"`'),
    ('version "1", "2"', "an app has one version"),
    ('Version "1"', "did you mean `version`?"),
    ("requires numpy", 'it stands in quotes, as in `requires "numpy>=2", "requests"`'),
    ('requires "a", numpy', 'it stands in quotes, as in `requires "numpy>=2", "requests"`'),
    ('requires ["a"]', "the texts behind `requires` stand there without brackets"),
    ('requires = ["a"]', 'write it without the `=`: `requires "numpy>=2", "requests"`'),
    ('requires "a" "b"', "write `,` before it"),
    ('require "a"', "did you mean `requires`?"),
    ('dependencies "a", "b"', "did you mean `requires`?"),
    ("def a(mission):", "Python stands in the package's hooks.py; here, a hook is only declared"),
    ("pluto 1", "`pluto 1` stands once, on the first line"),
]


@pytest.mark.parametrize(("line", "help"), SAID, ids=[line for line, _ in SAID])
def test_help_says_how_it_is_written_here(line: str, help: str) -> None:
    """Once, and nothing else is said of the line."""
    assert [d.help for d in mistakes(f"pluto 1\napp demo {{\n{line}\n}}\n")] == [help]


EXPECTED = [
    ("a =", "a kind of block"),
    ("a = pack.", "a kind of block"),
    ("a ->", "a block or `[`"),
    ("a -> [", "a block"),
    ("a -> b when", "a status"),
    ("modifier a emits", "a status"),
    ("category a can", "an action"),
    ("evaluator", "a name"),
]


@pytest.mark.parametrize(("line", "expected"), EXPECTED, ids=[line for line, _ in EXPECTED])
def test_a_missing_name_is_called_by_what_it_names(line: str, expected: str) -> None:
    """A block, a kind, a status, an action: not just a name."""
    (found,) = mistakes(f"pluto 1\napp demo {{\n{line}\n}}\n")
    assert found.code == "P0011" or found.message.startswith(f"expected {expected}, found")


def test_list_without_brackets_ends_with_its_line() -> None:
    """What follows in the next line is not taken for it, and it is told why."""
    (found,) = mistakes("pluto 1\napp demo {\ncategory a can x,  # and\ny\n}\n")
    assert found.help == "a list ends with its line: go on in the line above, behind the comma"


def test_marks_of_a_merge_are_called_that() -> None:
    """Each, for each has to go."""
    text = "<<<<<<< HEAD\na = K\n=======\na = L\n>>>>>>> theirs"
    found = mistakes(f"pluto 1\napp demo {{\n{text}\n}}\n")
    assert [d.help for d in found] == [
        "two versions were merged here: keep one, and remove the lines that mark them"
    ] * 3


@pytest.mark.parametrize(
    ("wide", "plain"),
    [
        ("a = K(x：1)", "a = K(x:1)"),
        ("a －＞ b", "a -> b"),
        ("[a，b] -> c", "[a,b] -> c"),
        ("[a、b] -> c", "[a,b] -> c"),
    ],
)
def test_wide_signs_are_mended(wide: str, plain: str) -> None:
    """A Chinese or Japanese keyboard writes them."""
    source = Source("app.pluto", f"pluto 1\napp demo {{\n{wide}\n}}\n")
    (found,) = mistakes(source.text)
    assert found.code == "P0003" and found.fix
    assert applied(source, [found.fix]) == f"pluto 1\napp demo {{\n{plain}\n}}\n"
