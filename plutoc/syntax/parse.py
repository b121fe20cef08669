"""Text → tree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lark import Token, Tree, UnexpectedToken

from plutoc.diagnostic import Diagnostic, Rejected, accept_or_raise
from plutoc.source import Source, Span
from plutoc.syntax import build, errors
from plutoc.syntax.grammar import parser
from plutoc.syntax.newlines import CLOSING, END, NEWLINE, OPENING
from plutoc.syntax.recover import diagnose
from plutoc.syntax.state import beginning, span
from plutoc.syntax.texts import HIDDEN, wrong_escapes
from plutoc.syntax.tree import File

LARGEST = 1 << 20
"""In bytes of UTF-8."""
DEEPEST = 64
MOST_DIGITS = 15
"""What a 64-bit float keeps."""

_BOM = "\ufeff"


def parse(source: Source) -> File:
    """Read a source; raise `Rejected` with every mistake in its syntax."""
    if len(source.text.encode("utf-8", "surrogatepass")) > LARGEST:
        raise Rejected((errors.too_large(source, LARGEST),))
    tokens = _tokens(source.text)
    _check_version(source, tokens)
    found = [
        *_hidden_characters(source, tokens),
        *_wrong_escapes(source, tokens),
        *_unwritable_numbers(source, tokens),
        *_too_deep(source, tokens),
    ]
    lark_tree = _lark_tree(tokens)
    if lark_tree is None:
        found.extend(diagnose(source, tokens))
    accept_or_raise(found)
    assert lark_tree is not None, "what the parser refuses has a diagnostic"
    return build.file(source, lark_tree)


def _tokens(text: str) -> list[Token]:
    """Return the parser's tokens. Some editors begin a file with a byte order mark: a space."""
    if text.startswith(_BOM):
        text = " " + text[1:]
    size = len(text)
    return [*parser().lex(text), Token(END, "", size, end_pos=size)]


def _lark_tree(tokens: Sequence[Token]) -> Tree[Token] | None:
    """Return Lark's tree, or None where the tokens are not in order."""
    state = beginning()
    tree = None
    try:
        for token in tokens:
            tree = state.feed_token(token)
    except UnexpectedToken:
        return None
    assert isinstance(tree, Tree)
    return tree


def _hidden_characters(source: Source, tokens: Sequence[Token]) -> Iterator[Diagnostic]:
    """Find them in texts and comments; anywhere else they are no token, and the parser says so."""
    elsewhere = {token.start_pos for token in tokens if token.type == "UNKNOWN"}
    for match in HIDDEN.finditer(source.text):
        if match.start() not in elsewhere and (match[0] != _BOM or match.start()):
            yield errors.hidden_character(source, Span(*match.span()))
    for token in tokens:
        if token.type == "TEXT" and "\t" in token:
            at = span(token).start + token.index("\t")
            yield errors.hidden_character(source, Span(at, at + 1))


def _wrong_escapes(source: Source, tokens: Sequence[Token]) -> Iterator[Diagnostic]:
    for token in tokens:
        if token.type == "TEXT":
            start = token.start_pos or 0
            for match in wrong_escapes(token):
                yield errors.unknown_escape(
                    source, Span(start + match.start(), start + match.end())
                )


def _unwritable_numbers(source: Source, tokens: Sequence[Token]) -> Iterator[Diagnostic]:
    for token in tokens:
        if token.type in ("NUMBER", "QUANTITY"):
            number = len(token) - len(token.lstrip("-0123456789."))  # without its unit
            if sum(map(str.isdigit, token[:number])) > MOST_DIGITS:
                start = token.start_pos or 0
                yield errors.unwritable_number(source, Span(start, start + number), MOST_DIGITS)


def _too_deep(source: Source, tokens: Sequence[Token]) -> Iterator[Diagnostic]:
    depth = 0
    for token in tokens:
        if token.type in OPENING:
            depth += 1
            if depth == DEEPEST + 1:
                yield errors.too_deep(source, span(token), DEEPEST)
        elif token.type in CLOSING:
            depth -= 1
        elif token.type == NEWLINE:
            depth = 0


def _check_version(source: Source, tokens: Sequence[Token]) -> None:
    """Refuse another version first: what else this compiler cannot read may be right in that one."""
    header = [token.type for token in tokens[:3]]
    if header in (["PLUTO", "NUMBER", NEWLINE], ["PLUTO", "NUMBER", END]) and tokens[1] != "1":
        raise Rejected((errors.unknown_version(source, span(tokens[1])),))
