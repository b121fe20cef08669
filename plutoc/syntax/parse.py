"""Text → tree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lark import Token

from plutoc.diagnostic import Diagnostic, accept_or_raise, in_order
from plutoc.source import LARGEST, Source, Span
from plutoc.syntax import build, errors
from plutoc.syntax.characters import HIDDEN
from plutoc.syntax.grammar import end_of, lexed, tree_of
from plutoc.syntax.recover import recover
from plutoc.syntax.texts import wrong_escapes
from plutoc.syntax.tokens import END, NEWLINE, span
from plutoc.syntax.tree import File

_BOM = "\ufeff"


def parse(source: Source) -> File:
    """Read a source; raise `Rejected` with every mistake in its syntax."""
    file, found = read(source)
    accept_or_raise(found)
    return file


def read(source: Source) -> tuple[File, tuple[Diagnostic, ...]]:
    """Return the tree of any text, and every mistake in its syntax.

    What cannot be read is a `BadStatement` there. Of a source that is too large, or in another
    version of the language, nothing is read: there can be more wrong with it than is told. So there
    can behind the first thousand mistakes.
    """
    if len(source.text.encode("utf-8", "surrogatepass")) > LARGEST:
        return build.empty(source), (errors.too_large(source, LARGEST),)
    tokens = _tokens(source.text)
    version = _other_version(source, tokens)
    if version is not None and version.fix is None:
        return build.empty(source), (version,)
    found = [version] if version else []
    found += [*_hidden_characters(source, tokens), *_wrong_escapes(source, tokens)]
    node = tree_of(tokens)
    if node is not None:
        return build.file(source, node), in_order(found)
    file, mistakes = recover(source, tokens)
    return file, in_order((*found, *mistakes))


def _tokens(text: str) -> list[Token]:
    """Return the parser's tokens. Some editors begin a file with a byte order mark: a space."""
    if text.startswith(_BOM):
        text = " " + text[1:]
    return [*lexed(text), end_of(text)]


def _hidden_characters(source: Source, tokens: Sequence[Token]) -> Iterator[Diagnostic]:
    """Find them in texts and comments; anywhere else they are no token, and the parser says so."""
    if not _is_plain(source.text):
        elsewhere = {token.start_pos for token in tokens if token.type == "UNKNOWN"}
        for match in HIDDEN.finditer(source.text):
            if match.start() not in elsewhere and (match[0] != _BOM or match.start()):
                yield errors.hidden_character(source, Span(*match.span()))
    for token in tokens:
        if token.type == "TEXT" and "\t" in token:
            at = span(token).start + token.index("\t")
            yield errors.hidden_character(source, Span(at, at + 1))


def _is_plain(text: str) -> bool:
    """Return whether there are only letters and signs that stand on any keyboard, and blanks."""
    shown = text.replace("\r\n", "").replace("\n", "").replace("\t", "")
    return shown.isascii() and shown.isprintable()


def _wrong_escapes(source: Source, tokens: Sequence[Token]) -> Iterator[Diagnostic]:
    for token in tokens:
        if token.type == "TEXT":
            start = span(token).start
            for match in wrong_escapes(token):
                yield errors.unknown_escape(
                    source, Span(start + match.start(), start + match.end())
                )


def _other_version(source: Source, tokens: Sequence[Token]) -> Diagnostic | None:
    """Refuse another version first: what else this compiler cannot read may be right in that one.

    `1.0` is no other one: it is mended, and the rest is read.
    """
    header = [token.type for token in tokens[:3]]
    if header in (["PLUTO", "NUMBER", NEWLINE], ["PLUTO", "NUMBER", END]) and tokens[1] != "1":
        if float(tokens[1]) == 1:
            return errors.wrong_header(source, span(tokens[0]).to(span(tokens[1])))
        return errors.unknown_version(source, span(tokens[1]))
    return None
