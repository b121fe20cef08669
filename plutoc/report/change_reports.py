"""What changed in meaning, for people on a terminal, for pull requests, and for programs."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from json import dumps
from typing import NamedTuple

from plutoc.diff.model import Change, Difference, Importance
from plutoc.report.json import Place, place
from plutoc.report.terminal import BLUE, BOLD, RED, paint
from plutoc.source import Source, Span
from plutoc_runtime.domain.text import counted, printable

HEADINGS = {
    Importance.SAFETY: "Safety and failures",
    Importance.MISSIONS: "Where missions go",
    Importance.PEOPLE: "What people write and enter",
    Importance.FORM: "Names and arrangement",
}
NOTHING = "nothing changed in meaning"
_MOST_FOR_A_CHANGE = 3
"""Of one source, for one change."""


_TICKS = re.compile(r"`+")
_MOST_CHANGES, _MOST_LINES, _WIDEST = 40, 60, 160
"""Of a section, of each source, and of a line: a comment on GitHub has room for 65,536 characters."""


class ShownLine(NamedTuple):
    """A line of one of the sources."""

    is_new: bool
    path: str
    number: int
    text: str


def headline(found: Difference) -> str:
    """Say how much there is."""
    if not found.changes:
        return NOTHING
    return f"{counted(len(found.changes), 'change')} in meaning"


def sections(found: Difference) -> Iterator[tuple[Importance, tuple[Change, ...]]]:
    """Yield the changes by importance."""
    for importance in Importance:
        changes = tuple(c for c in found.changes if c.importance is importance)
        if changes:
            yield importance, changes


def lines_of(found: Difference, change: Change) -> tuple[ShownLine, ...]:
    """Return the lines that show a change, those of the old source first, each once."""
    return (
        *_lines_at(found.old, change.was, is_new=False),
        *_lines_at(found.new, change.now, is_new=True),
    )


def _lines_at(source: Source, spans: Sequence[Span], *, is_new: bool) -> Iterator[ShownLine]:
    numbers = dict.fromkeys(source.position(span.start)[0] for span in spans)
    for number in tuple(numbers)[:_MOST_FOR_A_CHANGE]:
        text = source.line(number).strip()
        yield ShownLine(is_new=is_new, path=source.path, number=number, text=text)


def text(found: Difference, *, colour: bool) -> str:
    """Return a report: a sentence a change, with the lines of both sources that show it."""
    which = f"{found.old.path} → {found.new.path}: {headline(found)}"
    lines = [paint(which, BOLD, colour)]
    for importance, changes in sections(found):
        hue = RED if importance is Importance.SAFETY else BLUE
        lines += ["", paint(HEADINGS[importance], hue, colour)]
        before: tuple[ShownLine, ...] = ()
        for change in changes:
            lines.append(f"  * {printable(change.sentence)}")
            shown = _told(lines_of(found, change))
            if shown != before:  # several changes may stand on the same lines
                lines += [f"      {_line(one)}" for one in shown]
            before = shown
    return "\n".join(lines) + "\n"


def _told(shown: tuple[ShownLine, ...]) -> tuple[ShownLine, ...]:
    """Leave out old lines that say what new ones say."""
    new = {one.text for one in shown if one.is_new}
    return tuple(one for one in shown if one.is_new or one.text not in new)


def _line(one: ShownLine) -> str:
    return f"{'+' if one.is_new else '-'} {one.path}:{one.number}: {printable(one.text)}"


def markdown(found: Difference) -> str:
    """Return a report: a list of sentences, and below it the lines of the sources that show them."""
    lines = [f"### {_code(found.new.path)}: {headline(found)}"]
    for importance, changes in sections(found):
        lines += ["", f"**{HEADINGS[importance]}**", ""]
        lines += [f"- {_sentence(change)}" for change in changes[:_MOST_CHANGES]]
        if len(changes) > _MOST_CHANGES:
            lines.append(f"- … and {len(changes) - _MOST_CHANGES:,} more")
    shown = _shown(found)
    if shown:
        longest = max((len(ticks) for ticks in _TICKS.findall("\n".join(shown))), default=0)
        fence = "`" * max(3, longest + 1)
        lines += ["", "<details><summary>The lines that show it</summary>", ""]
        lines += [f"{fence}diff", *shown, fence, "", "</details>"]
    return "\n".join(lines) + "\n"


def _sentence(change: Change) -> str:
    """Return a sentence in which only what stands in backquotes is any code."""
    parts = printable(change.sentence).split("`")
    plain = [_plain(part) if place % 2 == 0 else part for place, part in enumerate(parts)]
    return "`".join(plain)


def _plain(text: str) -> str:
    """Keep Markdown, HTML and mentions from meaning anything."""
    escaped = re.sub(r"([\\*_\[\]<>#|~&])", r"\\\1", text)
    return escaped.replace("@", "@\u200b")


def _code(text: str) -> str:
    longest = max((len(ticks) for ticks in _TICKS.findall(text)), default=0)
    ticks, blank = "`" * (longest + 1), " " if "`" in text else ""
    return f"{ticks}{blank}{text}{blank}{ticks}"


def _shown(found: Difference) -> list[str]:
    """Return the lines as a patch would show them: gone ones, then new ones."""
    old: dict[int, str] = {}
    new: dict[int, str] = {}
    for change in found.changes:
        for one in lines_of(found, change):
            (new if one.is_new else old)[one.number] = one.text
    both = set(old.values()) & set(new.values())
    return [*_marked("-", old, both), *_marked("+", new, both)]


def _marked(mark: str, lines: Mapping[int, str], both: Collection[str]) -> list[str]:
    told = [lines[number] for number in sorted(lines) if lines[number] not in both]
    more = [f"{mark} … and {len(told) - _MOST_LINES:,} more"] if len(told) > _MOST_LINES else []
    return [*(f"{mark} {_short(printable(line))}" for line in told[:_MOST_LINES]), *more]


def _short(line: str) -> str:
    return line if len(line) <= _WIDEST else f"{line[: _WIDEST - 1]}…"


def json(found: Difference) -> str:
    """Return everything that is known of the changes."""
    number = {
        importance.value: sum(change.importance is importance for change in found.changes)
        for importance in Importance
    }
    said = {
        "old": found.old.path,
        "new": found.new.path,
        "changed": bool(found.changes),
        "number": number,
        "changes": [_change(found, change) for change in found.changes],
    }
    # ASCII only, as for diagnostics: what an odd source holds stays a text within it
    return dumps(said, ensure_ascii=True, indent=2) + "\n"


def _change(found: Difference, change: Change) -> dict[str, object]:
    return {
        "kind": change.kind,
        "importance": change.importance.value,
        "sentence": change.sentence,
        "blocks": list(change.blocks),
        "statuses": [status.value for status in change.statuses],
        "before": change.before,
        "after": change.after,
        "old": _places(found.old, change.was),
        "new": _places(found.new, change.now),
    }


def _places(source: Source, spans: Sequence[Span]) -> list[Place]:
    return [{"file": source.path, **place(source, span)} for span in spans]
