"""Colours: every example is read without an error, and the files for editors are current."""

from __future__ import annotations

import tomllib
from importlib import import_module
from pathlib import Path

import pytest
from pygments import token

from plutoc.highlight.pygments_lexer import PlutoLexer
from plutoc.highlight.rules import grammar
from plutoc.syntax.tokens import OWNERS, SETTINGS, WORDS
from plutoc_runtime.domain.quantities import UNITS
from tests.paths import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*/*.pluto"))
TEXTMATE = ROOT / "editors" / "vscode" / "syntaxes" / "pluto.tmLanguage.json"


def tokens(text: str) -> list[tuple[object, str]]:
    """The tokens of a text that are not blank."""
    return [(kind, said) for kind, said in PlutoLexer().get_tokens(text) if said.strip()]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_is_coloured_whole(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    found = list(PlutoLexer().get_tokens(text))
    assert "".join(said for _, said in found) == text
    assert token.Error not in {kind for kind, _ in found}
    assert {token.Keyword, token.Operator, token.Name.Class} <= {kind for kind, _ in found}


@pytest.mark.parametrize("word", WORDS)
def test_each_word_of_the_language_is_a_keyword(word: str) -> None:
    assert tokens(f"{word} x") == [(token.Keyword, word), (token.Name, "x")]


@pytest.mark.parametrize("word", SETTINGS)
def test_the_word_of_a_setting_is_a_keyword_only_there(word: str) -> None:
    """Anywhere else it may be the name of a block."""
    assert (token.Keyword, word) in tokens(f'app a {{\n  {word} "1"\n}}')
    assert (token.Keyword, word) not in tokens(f'app {word} "A title" {{')
    assert token.Keyword not in {kind for kind, _ in tokens(f"{word} = K\n{word} -> [a, {word}]")}


@pytest.mark.parametrize("owner", OWNERS)
def test_the_words_before_fields_are_keywords_only_there(owner: str) -> None:
    """Anywhere else they may be names of blocks."""
    assert (token.Keyword, f"{owner} has") in tokens(f"app a {{\n  {owner} has a: text = 3\n}}")
    others = tokens(f"{owner} = K\nhas = K\n{owner} -> has\n[{owner}, has] -> {owner}")
    assert token.Keyword not in {kind for kind, _ in others}


@pytest.mark.parametrize("name", ["float", "mass", "photo"])
def test_what_an_action_gives_is_a_type(name: str) -> None:
    assert (token.Keyword.Type, name) in tokens(f"action a(b: int) -> {name} once")


@pytest.mark.parametrize("unit", UNITS)
def test_a_quantity_is_one_number(unit: str) -> None:
    assert tokens(f"(limit: -2.5 {unit})")[3] == (token.Number, f"-2.5 {unit}")


def test_a_word_before_a_colon_is_a_parameter() -> None:
    """Inside brackets the language's words are ordinary names."""
    assert (token.Name.Attribute, "policy") in tokens("allocate = DroneAllocator(policy: nearest)")


def test_a_sign_in_a_text_begins_no_comment() -> None:
    assert tokens('app a "no # comment"  # one')[-2:] == [
        (token.String.Double, '"no # comment"'),
        (token.Comment.Single, "# one"),
    ]


def test_the_grammar_for_editors_is_current(update: bool) -> None:
    if update:
        TEXTMATE.write_text(grammar(), encoding="utf-8")
    assert TEXTMATE.read_text(encoding="utf-8") == grammar()


def test_pygments_finds_the_lexer_where_the_package_says() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    module, _, name = project["entry-points"]["pygments.lexers"]["pluto"].partition(":")
    assert getattr(import_module(module), name) is PlutoLexer
