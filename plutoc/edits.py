"""Changes that mend a source for certain. None of them takes a comment away."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.source import Source, Span

_BLANK = " \t"
_ARROW_BEFORE = re.compile(r"->[ \t]*\Z")
_ARROW_BEHIND = re.compile(r"(?:\s|#[^\n]*)*->")
_COMMA_BEFORE = re.compile(r",\s*\Z")


def without_statement(source: Source, span: Span) -> Fix | None:
    """Return how to take out a statement that has its lines for itself, else None."""
    text = source.text
    first = text.rfind("\n", 0, span.start) + 1
    if text[first : span.start].lstrip("\ufeff").strip(_BLANK):
        return None  # something stands before it
    line_end = text.find("\n", span.end)
    end = len(text) if line_end < 0 else line_end
    behind = text[span.end : end].strip()
    if behind.startswith("#"):
        return Fix(span=Span(span.start, text.index("#", span.end)), text="")
    if behind:
        return None
    # a byte order mark stays the first of all
    return Fix(
        span=Span(first + text.startswith("\ufeff", first), min(end + 1, len(text))), text=""
    )


def without_item(source: Source, span: Span) -> Fix | None:
    """Return how to take an item that is not the first one out of a list."""
    comma = _COMMA_BEFORE.search(source.text, 0, span.start)
    return Fix(span=Span(comma.start(), span.end), text="") if comma else None


def without_arrow(
    source: Source, names: tuple[str, str], span: Span, guard: Span | None
) -> Fix | None:
    """Return how to take out the last arrow of a statement, which leads from one name to another.

    Where one of its ends is in brackets, other arrows hang on it as well: None.
    """
    if not is_single(source, names, span):
        return None
    end = (guard or span).end
    if _ARROW_BEHIND.match(source.text, end):  # not the last one
        return None
    if _ARROW_BEFORE.search(source.text, 0, span.start):  # only the tail of a longer flow
        return Fix(span=Span(span.start + len(names[0]), end), text="")
    return without_statement(source, Span(span.start, end))


def is_single(source: Source, names: tuple[str, str], span: Span) -> bool:
    """Say whether an arrow is written as just that, with neither of its ends in brackets."""
    first, last = map(re.escape, names)
    return bool(re.fullmatch(rf"{first}\s*->\s*{last}", source.quote(span)))


def applied(source: Source, fixes: Iterable[Fix]) -> str:
    """Return a source's text with changes made that do not overlap."""
    text, done = [], 0
    new_line = "\r\n" if re.match(r"[^\n]*\r\n", source.text) else "\n"
    for fix in sorted(fixes, key=lambda fix: (fix.span.start, fix.span.end)):
        text += [source.text[done : fix.span.start], fix.text.replace("\n", new_line)]
        done = fix.span.end
    return "".join([*text, source.text[done:]])


def compatible(found: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return those of the findings whose fixes can be made together, the first ones first."""
    taken: list[Diagnostic] = []
    fixes: list[Fix] = []
    for diagnostic in found:
        fix = diagnostic.fix
        if fix and (fix in fixes or not any(_overlap(fix.span, other.span) for other in fixes)):
            taken.append(diagnostic)
            fixes.append(fix)
    return tuple(taken)


def _overlap(one: Span, other: Span) -> bool:
    if one.start == other.start:
        return True  # in which order would two texts be put there?
    first, second = sorted((one, other), key=lambda span: span.start)
    return second.start < first.end
