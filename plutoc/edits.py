"""Edits that certainly fix a source. None of them removes a comment."""

from __future__ import annotations

import re
from collections.abc import Iterable

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.source import Source, Span

_BLANK = " \t"
_ARROW_BEHIND = re.compile(r"(?:\s|#[^\n]*)*->")


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


def line_below(source: Source, span: Span, text: str) -> Fix:
    """Return how to write a line below the one in which something ends, as far in as that one."""
    before = source.text[source.text.rfind("\n", 0, span.start) + 1 : span.start].lstrip("\ufeff")
    indent = before[: len(before) - len(before.lstrip(_BLANK))]
    end = source.text.find("\n", span.end)
    end = len(source.text) if end < 0 else end
    end -= source.text.endswith("\r", span.end, end)
    return Fix(span=Span(end, end), text=f"\n{indent}{text}")


def without_item(source: Source, span: Span) -> Fix | None:
    """Return how to take an item that is not the first one out of a list."""
    comma = _last_sign(source.text, span.start)
    if not source.text.startswith(",", comma):
        return None
    return Fix(span=Span(comma, span.end), text="")


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
    arrow = _last_sign(source.text, span.start) - 1
    if arrow >= 0 and source.text.startswith("->", arrow):  # only the tail of a longer flow
        return Fix(span=Span(span.start + len(names[0]), end), text="")
    return without_statement(source, Span(span.start, end))


def _last_sign(text: str, end: int) -> int:
    """Return where the last character before `end` stands that is not blank, or 0."""
    at = end - 1
    while at > 0 and text[at].isspace():
        at -= 1
    return max(at, 0)


def is_single(source: Source, names: tuple[str, str], span: Span) -> bool:
    """Return whether an arrow is written as just that, with neither of its ends in brackets."""
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


def compatible(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return those of the findings whose fixes can be made together, by their places."""
    taken: list[Diagnostic] = []
    last = Fix(span=Span(-1, -1), text="")
    fixable = [(d.fix.span.start, d.fix.span.end, i, d) for i, d in enumerate(found) if d.fix]
    for start, _, _, diagnostic in sorted(fixable, key=lambda one: one[:3]):
        assert diagnostic.fix is not None
        # two at one place: in which order would their texts stand there?
        apart = start >= last.span.end and start > last.span.start
        if apart or diagnostic.fix == last:
            taken.append(diagnostic)
            last = diagnostic.fix
    return tuple(taken)
