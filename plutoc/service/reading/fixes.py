"""What an editor offers to do about a place: certain fixes, and stubs of hooks."""

from __future__ import annotations

import re
from dataclasses import dataclass

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.emit.hooks_file import hooks_file
from plutoc.graph.built_in import ACTIONS
from plutoc.hooks.add import with_stubs
from plutoc.hooks.check import missing
from plutoc.service.document import Document
from plutoc.service.symbols import HOOKS, at
from plutoc.source import Source, Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Mend:
    """A diagnostic, and the change that certainly mends it."""

    title: str
    diagnostic: Diagnostic
    fix: Fix


def mends(document: Document, within: Span) -> tuple[Mend, ...]:
    """Return the fixes of what is wrong with a stretch of the app's text."""
    return tuple(
        Mend(title=_title(one, one.fix), diagnostic=one, fix=one.fix)
        for one in document.diagnostics
        if one.fix and one.source is document.source
        if one.span.start <= within.end and within.start <= one.span.end
    )


def _title(diagnostic: Diagnostic, fix: Fix) -> str:
    """Say what a fix does, in a few words."""
    gone, new = diagnostic.source.quote(fix.span).strip(), fix.text.strip()
    if not new:
        return f"Remove `{_short(gone)}`"
    return f"Write `{_short(new)}`" if not gone else f"Replace `{_short(gone)}` by `{_short(new)}`"


def _short(text: str) -> str:
    line = re.sub(r"\s+", " ", text)
    return line if len(line) <= 40 else f"{line[:39]}…"


def lacking_hook(document: Document, offset: int) -> str | None:
    """Return the hook that is named at a place and that hooks.py does not define yet."""
    one = at(document.names, offset)
    if one is None or one.role not in HOOKS or document.checked is None:
        return None
    if document.hooks is None:
        return one.name if one.name not in ACTIONS else None
    return one.name if one.name in missing(document.checked, document.hooks) else None


def with_stub(document: Document, name: str) -> tuple[Fix, ...] | None:
    """Return the edits of hooks.py that write a hook's stub; None where it cannot be written.

    Where there is no hooks.py yet, they make one with the stubs of all hooks.
    """
    if document.checked is None:
        return None
    if document.hooks is None:
        return (Fix(span=Span(0, 0), text=hooks_file(document.checked)),)
    return changes(document.hooks, with_stubs(document.checked, document.hooks, only=name))


def changes(source: Source, after: str) -> tuple[Fix, ...]:
    """Return the edits that make another text of one, line by line."""
    from difflib import SequenceMatcher  # dear to load

    old, new = source.text.splitlines(keepends=True), after.splitlines(keepends=True)
    starts = [0]
    for line in old:
        starts.append(starts[-1] + len(line))
    matcher = SequenceMatcher(None, old, new, autojunk=False)
    return tuple(
        Fix(span=Span(starts[a], starts[b]), text="".join(new[c:d]))
        for what, a, b, c, d in matcher.get_opcodes()
        if what != "equal"
    )
