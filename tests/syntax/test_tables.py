"""The straight way and Lark's agree: on the tables, on every token, on every tree."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice
from pathlib import Path
from random import Random

import lark
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.syntax.grammar import parser
from plutoc.syntax.lalr import Child, Node, tree_of
from plutoc.syntax.lex import lexed, scanned
from plutoc.syntax.newlines import END
from plutoc.syntax.tabulate import tabulated
from plutoc.syntax.tokens import Token
from plutoc.syntax.unreadable import DEEPEST, marked
from plutoc_grammar import tables
from tests.format.layouts import Liberty, laid_out, words_of
from tests.mutations import mutants

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted(ROOT.glob("examples/*/app.pluto"))
CASES = sorted(ROOT.glob("tests/cases/*/*.pluto"))

Shape = tuple[object, ...] | None
"""A tree as plain values."""


def text_of(path: Path) -> str:
    """Read a file as it is, its line ends too."""
    return path.read_bytes().decode("utf-8", "replace")


def larks_tree(tokens: Iterable[Token]) -> lark.Tree[lark.Token] | None:
    state = parser().parse_interactive("")
    tree = None
    for token in tokens:
        place = (token.start_pos, token.line, 1, token.line, 1, token.end_pos)
        try:
            tree = state.feed_token(lark.Token(token.type, str(token), *place))
        except lark.UnexpectedToken:
            return None
    assert isinstance(tree, lark.Tree)
    return tree


def shape(node: Child | lark.Tree[lark.Token] | lark.Token) -> Shape:
    """Return a tree, ours or Lark's, as what can be compared."""
    if node is None:
        return None
    if isinstance(node, Node):
        return (node.data, node.start_pos, node.end_pos, *map(shape, node.children))
    if isinstance(node, lark.Tree):
        place = (node.meta.start_pos, node.meta.end_pos)
        return (str(node.data), *place, *map(shape, node.children))
    return (node.type, str(node), node.start_pos, node.end_pos)


def agree(text: str) -> bool:
    """Hold the two ways against each other; say whether they take the text for an app."""
    ours = [(t.type, str(t), t.start_pos, t.end_pos, t.line) for t in scanned(text)]
    theirs = [(t.type, str(t), t.start_pos, t.end_pos, t.line) for t in parser().lex(text)]
    assert ours == theirs
    tokens = [*marked(lexed(text)), Token(END, "", len(text), len(text), 0)]
    tree = larks_tree(tokens)
    assert shape(tree_of(tokens)) == shape(tree)
    return tree is not None


def test_the_tables_are_those_of_the_grammar(update: bool) -> None:
    """`pytest tests/syntax/test_tables.py --update` writes them."""
    path = Path(tables.__file__)
    if update:
        path.write_text(tabulated(), encoding="utf-8")
    assert path.read_text(encoding="utf-8") == tabulated()


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.parent.name)
def test_both_ways_read_every_example(path: Path) -> None:
    """As it is written, and in other layouts."""
    text = text_of(path)
    assert agree(text)
    words, dice = words_of(text), Random(1)
    assert all(agree(laid_out(words, dice, Liberty()).lstrip("\ufeff")) for _ in range(20))


def test_both_ways_agree_on_all_cases() -> None:
    """On what they refuse, too."""
    assert len(CASES) > 100
    assert {agree(text_of(path)) for path in CASES} == {True, False}


def test_both_ways_agree_on_mutants() -> None:
    """Most of which have a mistake."""
    took = [agree(mutant.text) for mutant in islice(mutants(1000, seed=11), 1000)]
    assert 100 < sum(took) < 900


@pytest.mark.parametrize(
    "text",
    [
        "",
        "\r",
        "\ufeffpluto 1",
        '"open',
        '"open\\',
        "a = K(x: " + "[" * (DEEPEST + 1),
        f"pluto 1\napp a {{ b = K(x: {'[' * DEEPEST}{']' * DEEPEST}) }}",
        "1" * 16 + " 5min 5 m/s 5%  -0.5.5 5m/ -x",
        "pluto plut plutos use\tas\r\n\r# \r\n->-> - >",
        "é = Ж\u0301 # \u2028\n\u2028\x0b\x0c\x85\ud800",
    ],
    ids=lambda text: repr(text[:20]),
)
def test_both_ways_agree_on_odd_texts(text: str) -> None:
    agree(text)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(
    st.lists(
        st.sampled_from([*tables.WORDS, *'{}()[]=,:.\n\r"#', "->", "a", "5 m", "-1", " ", "\\"])
        | st.characters(),
        max_size=30,
    ).map("".join)
)
def test_both_ways_agree_on_any_text(text: str) -> None:
    """By itself, and where an app has its statements."""
    agree(text)
    agree(f"pluto 1\napp a {{\n{text}\n}}\n")
