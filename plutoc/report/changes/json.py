"""Changes for programs: one JSON object, described in docs/diff.md."""

from __future__ import annotations

from collections.abc import Sequence
from json import dumps

from plutoc.diff.model import Change, Difference, Importance
from plutoc.source import Source, Span

_Place = dict[str, str | int]


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


def _places(source: Source, spans: Sequence[Span]) -> list[_Place]:
    return [_place(source, span) for span in spans]


def _place(source: Source, span: Span) -> _Place:
    line, column = source.position(span.start)
    end_line, end_column = source.position(span.end)
    return {
        "file": source.path,
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
    }
