"""Changes as Markdown, for a pull request.

Titles and texts of a source can hold anything: here nothing of them becomes a link, a tag or a
mention.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping

from plutoc.diff.model import Change, Difference
from plutoc.report.changes.arranged import HEADINGS, headline, lines_of, sections
from plutoc_runtime.domain.text import printable

_TICKS = re.compile(r"`+")
_MOST_CHANGES, _MOST_LINES, _WIDEST = 40, 60, 160
"""Of a section, of each source, and of a line: a comment on GitHub has room for 65,536 characters."""


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
