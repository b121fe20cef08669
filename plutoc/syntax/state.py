"""The parser as a value that can be asked, fed a token, and copied before a try."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, cast

from lark import UnexpectedToken

from plutoc.syntax.grammar import parser
from plutoc.syntax.tokens import Token


class State(Protocol):
    """What we use of Lark's interactive parser, which has no types of its own for it."""

    def feed_token(self, token: Token) -> object:
        """Go on by one token."""
        ...

    def choices(self) -> dict[str, object]:
        """Return what could come next, but for some that would turn out to be wrong."""
        ...

    def accepts(self) -> set[str]:
        """Return what could come next."""
        ...

    def copy(self, deepcopy_values: bool) -> State:
        """Return another one at the same place."""
        ...


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
    """Say whether it could go on with these."""
    trial = copied(state)
    return all(feeds(trial, token) for token in tokens)
