"""Every mistake in a syntax, one diagnostic each: after one, go on with the next statement.

Only called where there is a mistake. What stands between two newlines (as newlines.py leaves them)
is a line; a mistake costs the rest of its line, and the parser goes back to where it was before it.
"""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token

from plutoc.diagnostic import Diagnostic
from plutoc.source import Source
from plutoc.syntax import errors
from plutoc.syntax.explain import explain
from plutoc.syntax.newlines import END, NEWLINE
from plutoc.syntax.state import State, beginning, copied, feeds, made_up, span

_HEADER = (("PLUTO", "pluto"), ("NUMBER", "1"), (NEWLINE, ""))
_APP = (("APP", "app"), ("NAME", "app"), ("LBRACE", "{"))


def diagnose(source: Source, tokens: Sequence[Token]) -> list[Diagnostic]:
    """Return what is wrong with the order of the tokens."""
    state = beginning()
    found: list[Diagnostic] = []
    apps: list[Token] = []
    i = 0
    if tokens[0].type != "PLUTO":
        found.append(errors.no_header(source, span(tokens[0])))
        _feed_made_up(state, _HEADER)
    line = i
    before = copied(state)
    while i < len(tokens):
        token = tokens[i]
        if i == line:
            before = copied(state)
        if token.type == "APP":
            apps.append(token)
        if feeds(state, token):
            i += 1
            if token.type in (NEWLINE, "LBRACE"):
                line = i
            continue
        found.append(explain(source, state, tokens, line, i, apps))
        state = before
        choices = state.choices()
        if "PLUTO" in choices:
            i = _behind_line(tokens, i)
            _feed_made_up(state, _HEADER)
        elif "APP" in choices:
            i = _enter_app(state, tokens, line)
        elif "RBRACE" in choices and token.type != END:
            i = _behind_line(tokens, line)
        else:
            break  # behind the app's end, or at the file's
        line = i
    return found


def _enter_app(state: State, tokens: Sequence[Token], line: int) -> int:
    """After a broken line before the app's statements: the next place at which to go on.

    That is the next `use`, or what stands in the app's braces. Everything between is passed over in
    silence, since it went wrong only because of this line.
    """
    for i in range(line, len(tokens)):
        if tokens[i].type == "LBRACE":
            _feed_made_up(state, _APP)
            return i + 1
        if tokens[i].type == NEWLINE and tokens[i + 1].type in ("USE", "APP"):
            return i + 1
    return len(tokens)


def _behind_line(tokens: Sequence[Token], i: int) -> int:
    """Return the place of the next line, with what stands in braces passed over."""
    depth = 0
    while tokens[i].type != END:
        depth += {"LBRACE": 1, "RBRACE": -1}.get(tokens[i].type, 0)
        i += 1
        if tokens[i - 1].type == NEWLINE and depth <= 0:
            break
    return i


def _feed_made_up(state: State, tokens: Sequence[tuple[str, str]]) -> None:
    """Feed tokens that the source does not have, to stand where it should have them."""
    for kind, text in tokens:
        state.feed_token(made_up(kind, text))
