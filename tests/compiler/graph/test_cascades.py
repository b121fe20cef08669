"""One mistake of a source is told once, of syntax and of names together."""

from __future__ import annotations

import pytest

from plutoc.diagnostic import Diagnostic
from plutoc.graph.resolve import resolved
from plutoc.source import Source
from plutoc.syntax.parse import read
from plutoc.syntax.tree import BlockDecl
from tests.compiler.graph.fakes import BLOCKS


def found_in(statements: str, uses: str = "") -> list[Diagnostic]:
    """Return all that is wrong with an app, in the order of its lines."""
    file, mistakes = read(Source("demo.pluto", f"pluto 1\n{uses}\napp demo {{\n{statements}\n}}\n"))
    graph, found = resolved(file, BLOCKS)
    blocks = [each for each in file.app.statements if isinstance(each, BlockDecl)]
    assert mistakes or found or len(graph.nodes) == len(blocks), "nothing is lost in silence"
    return sorted((*mistakes, *found), key=lambda d: d.span.start)


def codes(statements: str, uses: str = "") -> list[str]:
    """Return the code of each finding, with the text that it points at."""
    found = found_in(statements, uses)
    return [f"{d.code} {d.source.quote(d.span)}" for d in found]


@pytest.mark.parametrize(
    "bad",
    [
        "wait Pass",
        "wait = Pass(",
        "wait: Pass",
        "wa it = Pass",
        "wa\nit = Pass",
        "wait =\nPass",
        "wa?it = Pass",
        '"wait = Pass',
        "when = Pass",
        "= Pass wait",
        "a = Pass wait = Pass",
    ],
)
def test_bad_declaration_declares_its_name(bad: str) -> None:
    """So what leads to it is in order."""
    assert len(codes(f"{bad}\nstart -> wait -> end")) == 1


@pytest.mark.parametrize("spoilt", ["Wait = Pass", "wäit = Pass", "wait = Psas", "wait -> Pass"])
def test_wrong_declaration_declares_its_name(spoilt: str) -> None:
    """For all mistakes in the name itself, or in its kind."""
    assert len(codes(f"{spoilt}\nstart -> wait -> end")) == 1


def test_syntax_and_names_come_together() -> None:
    """In one run, and each mistake."""
    text = "a = Pass\nb Pass\nc = Psas\na -> b -> c -> zzz"
    assert codes(text) == ["P0001 Pass", "P1012 Psas", "P1032 zzz"]


def test_edge_that_cannot_be_read_hides_no_missing_block() -> None:
    """It declares nothing."""
    assert codes("a -> -> zzz\na = Pass\nstart -> zzz") == ["P0001 ->", "P1032 zzz"]


def test_nothing_is_called_unused_beside_a_mistake() -> None:
    """The mistake may be what keeps it from being used."""
    assert codes("a = srvey.Scan", "use survey") == ["P1011 srvey"]
    assert codes("evaluator e\na = Judge(hook: x, strictness: 1)") == ["P1022 x"]
    assert codes("policy p\na = Work(way: p") == ["P0011 ("]


def test_misspelt_parameter_is_not_missing_as_well() -> None:
    """Of a hook and of a value; but what is far off is missing."""
    assert codes("evaluator e\na = Judge(strictnes: 1)") == ["P1013 strictnes"]
    assert codes("modifier m\na = Call(hok: m)") == ["P1013 hok"]
    assert codes("modifier m\na = Call(zzz: m)") == ["P1015 a"]


def test_name_torn_by_a_line_break_is_one_mistake() -> None:
    """Where either half is a name by itself."""
    assert codes("watch = Pass\nstart -> wat\nch -> end") == ["P1032 wat"]


def test_statement_repeated_is_one_mistake() -> None:
    """However many edges it has."""
    line = "start -> a -> b -> end\n"
    assert codes("a = Pass\nb = Pass\n" + line * 2) == ["P1035 start -> a"]


def test_prefixes_in_each_others_place_are_not_lost() -> None:
    """Two wrong names cannot vouch for each other."""
    assert codes("x = bar.foo\ny = foo.bar")


def test_brackets_make_no_million_edges() -> None:
    """One finding, and soon."""
    many = ", ".join(["a"] * 1000)
    found = codes(f"a = Pass\n[{many}] -> [{many}]")
    assert [code[:5] for code in found] == ["P1039"]


def test_much_that_cannot_be_read_is_told_without_guesses() -> None:
    """Where so much is unclear, nothing is called unknown."""
    text = "".join(f"b{i} ? = Pass\n" for i in range(30))
    assert {code[:5] for code in codes(f"{text}start -> zzz")} == {"P0003"}
