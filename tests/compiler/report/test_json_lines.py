"""Diagnostics for programs."""

from __future__ import annotations

import json

from plutoc.diagnostic import Diagnostic, Fix, Related, Severity
from plutoc.report.json import render_line
from plutoc.source import Source, Span


def test_line_has_all_the_facts() -> None:
    """One object a line; lines and columns from 1, in characters."""
    source = Source("dir/app.pluto", "pluto 1\nü bad\n")
    line = render_line(
        Diagnostic(
            code="P0003",
            severity=Severity.ERROR,
            message="wrong",
            source=source,
            span=Span(10, 13),
            related=(Related(source=source, span=Span(0, 5), label="there"),),
            help="mend it",
            fix=Fix(span=Span(10, 13), text="good"),
        )
    )
    facts = json.loads(line)
    assert "\n" not in line
    assert facts.pop("rendered").startswith("error[P0003]: wrong\n")
    place = {"line": 2, "column": 3, "end_line": 2, "end_column": 6}
    assert facts == {
        "code": "P0003",
        "severity": "error",
        "message": "wrong",
        "file": "dir/app.pluto",
        **place,
        "help": "mend it",
        "related": [
            {
                "file": "dir/app.pluto",
                "line": 1,
                "column": 1,
                "end_line": 1,
                "end_column": 6,
                "label": "there",
            }
        ],
        "fix": [{**place, "text": "good"}],
    }
