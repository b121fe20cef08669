"""What is said of names, values and edges, each mistake once, of syntax and of names together.

`mistakes.txt` has the statements of an app of the blocks in `fakes.py`, and what is found; nothing, where a case
looks like a mistake but is none. Lines that begin with `use` stand above the app.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.diagnostic import Diagnostic
from plutoc.graph.resolve import resolved
from plutoc.source import Source
from plutoc.syntax.parse import read
from plutoc.syntax.tree import BlockDecl
from tests.compiler.graph.fakes import BLOCKS
from tests.kit.findings import findings
from tests.kit.sections import Section, compare, params


def found_in(statements: str) -> list[Diagnostic]:
    """Return all that is wrong with an app, in the order of its lines."""
    uses = [line for line in statements.splitlines() if line.startswith("use ")]
    rest = [line for line in statements.splitlines() if not line.startswith("use ")]
    text = "\n".join(["pluto 1", *uses, "app demo {", *rest, "}", ""])
    file, mistakes = read(Source("demo.pluto", text))
    graph, found = resolved(file, BLOCKS)
    blocks = [each for each in file.app.statements if isinstance(each, BlockDecl)]
    assert mistakes or found or len(graph.nodes) == len(blocks), "nothing is lost in silence"
    return sorted((*mistakes, *found), key=lambda d: d.span.start)


@pytest.mark.parametrize("case", params(Path(__file__).with_name("mistakes.txt")))
def test_a_mistake_is_told_once_and_with_what_to_do(case: Section, update: bool) -> None:
    compare(case, findings(found_in(case.given)), update)


def test_brackets_make_no_million_edges() -> None:
    """One finding, and soon."""
    many = ", ".join(["a"] * 1000)
    assert [found.code for found in found_in(f"a = Pass\n[{many}] -> [{many}]")] == ["P1039"]


def test_much_that_cannot_be_read_is_told_without_guesses() -> None:
    """Where so much is unclear, nothing is called unknown."""
    text = "".join(f"b{i} ? = Pass\n" for i in range(30))
    assert {found.code for found in found_in(f"{text}start -> zzz")} == {"P0003"}


@pytest.mark.parametrize(
    ("written", "code"),
    [(f'version "{"1" * 5000}"', "P1040"), (f'requires "a; {"(" * 3000}"', "P1041")],
    ids=["version", "requires"],
)
def test_what_is_very_long_is_refused(written: str, code: str) -> None:
    """Python's own reader of numbers, and of requirements, gives up."""
    assert [found.code for found in found_in(written)] == [code]
