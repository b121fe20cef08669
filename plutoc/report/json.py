"""Diagnostics for programs: one JSON object a line."""

from __future__ import annotations

import json

from plutoc.diagnostic import Diagnostic
from plutoc.report.text import render_one
from plutoc.source import Source, Span

Place = dict[str, str | int]


def render_line(diagnostic: Diagnostic) -> str:
    """Return one diagnostic as a JSON object on one line, without its end."""
    source, fix = diagnostic.source, diagnostic.fix
    facts = {
        "code": diagnostic.code,
        "severity": diagnostic.severity.value,
        "message": diagnostic.message,
        "file": source.path,
        **place(source, diagnostic.span),
        "help": diagnostic.help,
        "related": [
            {
                "file": related.source.path,
                **place(related.source, related.span),
                "label": related.label,
            }
            for related in diagnostic.related
        ],
        "fix": [{**place(source, fix.span), "text": fix.text}] if fix else None,
        "rendered": render_one(diagnostic, colour=False),
    }
    # ASCII only: a line of this cannot be broken by what an odd source holds.
    return json.dumps(facts, ensure_ascii=True)


def place(source: Source, span: Span) -> Place:
    """Return where a span begins and ends, in the words of all JSON reports."""
    line, column = source.position(span.start)
    end_line, end_column = source.position(span.end)
    return {"line": line, "column": column, "end_line": end_line, "end_column": end_column}
