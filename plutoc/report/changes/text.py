"""Changes for people on a terminal."""

from __future__ import annotations

from plutoc.diff.model import Difference, Importance
from plutoc.report.changes.arranged import HEADINGS, Shown, headline, lines_of, sections
from plutoc.report.paint import BLUE, BOLD, RED, paint
from plutoc_runtime.domain.text import printable


def text(found: Difference, *, colour: bool) -> str:
    """Return a report: a sentence a change, with the lines of both sources that show it."""
    which = f"{found.old.path} → {found.new.path}: {headline(found)}"
    lines = [paint(which, BOLD, colour)]
    for importance, changes in sections(found):
        hue = RED if importance is Importance.SAFETY else BLUE
        lines += ["", paint(HEADINGS[importance], hue, colour)]
        before: tuple[Shown, ...] = ()
        for change in changes:
            lines.append(f"  * {printable(change.sentence)}")
            shown = _told(lines_of(found, change))
            if shown != before:  # several changes may stand on the same lines
                lines += [f"      {_line(one)}" for one in shown]
            before = shown
    return "\n".join(lines) + "\n"


def _told(shown: tuple[Shown, ...]) -> tuple[Shown, ...]:
    """Leave out old lines that say what new ones say."""
    new = {one.text for one in shown if one.is_new}
    return tuple(one for one in shown if one.is_new or one.text not in new)


def _line(one: Shown) -> str:
    return f"{'+' if one.is_new else '-'} {one.path}:{one.number}: {printable(one.text)}"
