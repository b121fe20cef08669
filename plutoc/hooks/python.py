"""From text to Python's own syntax tree, or to why there is none. Nothing of it is run."""

from __future__ import annotations

import ast
import codecs
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

from plutoc.source import Source, Span

_COOKIE = re.compile(r"[ \t\f]*#.*?coding[:=][ \t]*([-\w.]+)", re.ASCII)
_WORD = re.compile(r"[^\W\d]\w*|\.|[^\s\\]")
_LONGEST_CHAIN = 200
_NULL = "it holds a null byte, which is no text"


class Unreadable(Exception):
    """It is not Python. Carries the place, if Python told one, and what it said."""

    def __init__(self, why: str, span: Span | None) -> None:
        super().__init__(why)
        self.why, self.span = why, span


def parsed(source: Source) -> ast.Module:
    """Return a module's tree; raise `Unreadable` where it is not Python.

    The text's lines end with `\\n`, as Python reads them.
    """
    if "\0" in source.text:  # Pythons differ in what they say of it
        raise Unreadable(_NULL, None)
    _check_encoding(source)
    _check_chains(source.text)
    with _told(source):
        return ast.parse(source.text)


def check_compiles(source: Source) -> None:
    """Raise `Unreadable` for what the tree does not show: `await` in a `def`, names used twice."""
    with _told(source):
        # Only makes bytecode, of which nothing is run.
        compile(source.text, "hooks.py", "exec", dont_inherit=True)


def annotation(text: str) -> ast.expr | None:
    """Return the tree of an annotation in quotes; None where it is some other text."""
    try:
        with _told(Source("", text)):
            return ast.parse(text.strip(), mode="eval").body
    except Unreadable:
        return None


@contextmanager
def _told(source: Source) -> Iterator[None]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a wrong escape: Python will say so when it flies
            yield
    except SyntaxError as error:
        raise Unreadable(error.msg, _place(source, error)) from None
    except (RecursionError, MemoryError):
        raise Unreadable("it is nested too deep", None) from None
    except ValueError:  # before Python 3.12; since then it is a SyntaxError
        raise Unreadable(_NULL, None) from None


def _place(source: Source, error: SyntaxError) -> Span | None:
    if error.lineno is None:
        return None
    lines = source.text.count("\n") + 1
    number = min(max(error.lineno, 1), lines)
    column = min(max(error.offset or 1, 1), len(source.line(number)) + 1)
    return at(source, number, column - 1)


def at(source: Source, line: int, column: int, length: int = 1) -> Span:
    """Return a place by its line from 1 and its column from 0."""
    start = sum(len(text) + 1 for text in source.text.split("\n")[: line - 1]) + column
    return Span(start, start + length)


def column_of(line: str, byte: int) -> int:
    """Return a column in characters: Python counts them in bytes of UTF-8."""
    return len(line.encode("utf-8", "surrogatepass")[:byte].decode("utf-8", "ignore"))


def _check_encoding(source: Source) -> None:
    """Refuse a file that Python would read in another encoding than we have."""
    for number, line in enumerate(source.text.split("\n", 2)[:2], start=1):
        match = _COOKIE.match(line)
        if match is None:
            if line.strip() and not line.lstrip().startswith("#"):
                return  # Python looks at a second line only behind a comment or an empty one
            continue
        try:
            name = codecs.lookup(match[1]).name
        except (LookupError, ValueError):
            name = ""
        if name == "utf-8" or (name == "ascii" and source.text.isascii()):
            return
        why = f"it says that it is written in {match[1][:40]}, and hooks are read as UTF-8"
        raise Unreadable(why, at(source, number, match.start(1), len(match[1])))


def _check_chains(text: str) -> None:
    """Refuse `import a.b.c.…`: each further name costs Python a copy of all before it."""
    length, before = 0, ""
    for match in _WORD.finditer(text):
        word = match[0]
        if word == ".":
            length = length + 1 if before.isidentifier() else 0
        elif before != ".":
            length = 0
        if length > _LONGEST_CHAIN:
            raise Unreadable("it is nested too deep", Span(match.start(), match.end()))
        before = word
