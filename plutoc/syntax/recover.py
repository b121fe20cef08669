"""Every mistake in a syntax, one diagnostic each: after one, go on with the next statement.

Only called where there is a mistake. What stands between two newlines (as newlines.py leaves them)
is a line; a mistake costs the rest of its line, and the parser goes back to where it was before it.
"""

from __future__ import annotations

import difflib
from collections.abc import Sequence

from lark import Token

from plutoc.diagnostic import Diagnostic
from plutoc.source import Source
from plutoc.syntax import errors
from plutoc.syntax.explain import explain
from plutoc.syntax.newlines import END, NAME, NEWLINE
from plutoc.syntax.state import State, beginning, copied, feeds, made_up, span

_HEADER = (("PLUTO", "pluto"), ("NUMBER", "1"), (NEWLINE, ""))
_APP = (("APP", "app"), ("NAME", "app"), ("LBRACE", "{"))


def diagnose(source: Source, tokens: Sequence[Token]) -> list[Diagnostic]:
    """Return what is wrong with the order of the tokens."""
    if tokens[0].type == END:
        return [errors.no_app(source, span(tokens[0]))]
    state = beginning()
    found: list[Diagnostic] = []
    apps: list[Token] = []
    i = 0
    if tokens[0].type != "PLUTO":
        i = _behind_wrong_header(tokens)
        wrong = span(tokens[0]).to(span(tokens[max(i - 2, 0)]))
        error = errors.wrong_header if i else errors.no_header
        found.append(error(source, wrong))
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
        if END in state.choices():
            break  # behind the end of the app
        state = before
        choices = state.choices()
        if "PLUTO" in choices:
            i = _behind_line(tokens, i)
            if any(token.type == "LBRACE" for token in tokens[line:i]):
                break  # the whole app, on the first line
            _feed_made_up(state, _HEADER)
        elif "APP" in choices:
            i = _enter_app(state, tokens, line)
        elif "RBRACE" in choices and token.type != END:
            i = _behind_line(tokens, line)
        else:
            break
        line = i
    return found


def _behind_wrong_header(tokens: Sequence[Token]) -> int:
    """Return where the second line begins, if the first one means to be `pluto 1`; else 0."""
    end = next((i for i, token in enumerate(tokens) if token.type == NEWLINE), 0)
    near = difflib.get_close_matches(tokens[0].lower(), ["pluto"])
    means_it = tokens[1].type == "NUMBER" or (near and tokens[0].type == NAME)
    return end + 1 if means_it and end else 0


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
    """Return the place of the next line, with what stands in braces over several lines passed over."""
    depth = 0
    while tokens[i].type != END:
        token, following = tokens[i], tokens[i + 1]
        if token.type == "LBRACE" and (following.line or 0) > (token.line or 0):
            depth += 1
        elif token.type == "RBRACE" and depth:
            depth -= 1
        i += 1
        if token.type == NEWLINE and not depth:
            break
    return i


def _feed_made_up(state: State, tokens: Sequence[tuple[str, str]]) -> None:
    """Feed tokens that the source does not have, to stand where it should have them."""
    for kind, text in tokens:
        state.feed_token(made_up(kind, text))
