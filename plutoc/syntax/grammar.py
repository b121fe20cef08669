"""Lark's parser of the language: its tokens, its tree, and what it would have taken."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pkgutil import get_data
from typing import Protocol, cast

from lark import Lark, Token, Tree, UnexpectedToken
from lark.lexer import BasicLexer

from plutoc.syntax.layout import Layout
from plutoc.syntax.tokens import END


class State(Protocol):
    """What we use of Lark's interactive parser, which has no types of its own for it."""

    def feed_token(self, token: Token) -> object:
        """Go on by one token; return the tree at the end of the file."""
        ...

    def accepts(self) -> set[str]:
        """Return what could come next."""
        ...

    def copy(self, deepcopy_values: bool) -> State:
        """Return another one at the same place."""
        ...


@cache
def parser() -> Lark:
    """Return the parser of the language."""
    lark = Lark(
        (get_data("plutoc_grammar", "pluto.lark") or b"").decode(),
        start="file",
        parser="lalr",
        lexer="basic",
        postlex=Layout(),
        propagate_positions=True,
        maybe_placeholders=True,
    )
    lark.lexer = BasicLexer(lark.lexer_conf)  # else it makes one for each text, however short
    return lark


def lexed(text: str) -> list[Token]:
    """Return the tokens of a text; every text has some."""
    return list(parser().lex(text))


def end_of(text: str) -> Token:
    """Return the token at the end of a text."""
    return Token(END, "", len(text), 0, 0, 0, 0, len(text))


def tree_of(tokens: Iterable[Token]) -> Tree[Token] | None:
    """Return the tree of a whole source, or None where its tokens are not in order."""
    state, tree = beginning(), None
    try:
        for token in tokens:
            tree = state.feed_token(token)
    except UnexpectedToken:
        return None
    return cast("Tree[Token] | None", tree)


def beginning() -> State:
    """Return the parser before the first token."""
    return cast(State, parser().parse_interactive(""))


def copied(state: State) -> State:
    """Return another one at the same place. The trees of the two get mixed up: use neither."""
    return state.copy(deepcopy_values=False)


def feeds(state: State, token: Token) -> bool:
    """Go on by one token, if it is in order."""
    try:
        state.feed_token(token)
    except UnexpectedToken:
        return False
    return True


def would_feed(state: State, tokens: Iterable[Token]) -> bool:
    """Return whether it could go on with these."""
    trial = copied(state)
    return all(feeds(trial, token) for token in tokens)
