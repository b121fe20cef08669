"""Diagnostics as SARIF 2.1.0, which code hosts and editors read: one document a run.

SARIF is a standard of OASIS: "Static Analysis Results Interchange Format (SARIF) Version 2.1.0".
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import PurePath
from urllib.parse import quote

from plutoc.diagnostic import Diagnostic, Related, Severity
from plutoc.source import Source, Span

SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)

Json = Mapping[str, object]


def render(
    diagnostics: Sequence[Diagnostic],
    troubles: Sequence[str] = (),
    *,
    version: str,
    title: Callable[[str], str | None],
) -> str:
    """Return the document of a run, without an end of line.

    `troubles` are the sentences about files that could not be read; `title` says what a code means
    in a few words, if it is known.
    """
    codes = sorted({diagnostic.code for diagnostic in diagnostics})
    rule = {code: index for index, code in enumerate(codes)}
    invocation: dict[str, object] = {"executionSuccessful": not troubles}
    if troubles:
        invocation["toolExecutionNotifications"] = [
            {"level": "error", "message": {"text": sentence}} for sentence in troubles
        ]
    run = {
        "tool": {
            "driver": {
                "name": "plutoc",
                "version": version,
                "rules": [_rule(code, title(code)) for code in codes],
            }
        },
        "invocations": [invocation],
        "columnKind": "unicodeCodePoints",
        "results": [_result(d, rule[d.code]) for d in diagnostics],
    }
    # ASCII only: nothing that an odd source holds can break a reader.
    return json.dumps({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}, indent=1)


def _rule(code: str, title: str | None) -> Json:
    return {"id": code, "shortDescription": {"text": title}} if title else {"id": code}


def _result(diagnostic: Diagnostic, rule: int) -> Json:
    help = f"\nhelp: {diagnostic.help}" if diagnostic.help else ""
    result: dict[str, object] = {
        "ruleId": diagnostic.code,
        "ruleIndex": rule,
        "level": "error" if diagnostic.severity is Severity.ERROR else "warning",
        "message": {"text": diagnostic.message + help},
        "locations": [_location(diagnostic)],
    }
    if diagnostic.related:
        result["relatedLocations"] = [
            {"id": number, **_location(related)}
            for number, related in enumerate(diagnostic.related, start=1)
        ]
    if diagnostic.fix:
        replacement = {
            "deletedRegion": _region(diagnostic.source, diagnostic.fix.span),
            "insertedContent": {"text": diagnostic.fix.text},
        }
        change = {"artifactLocation": _file(diagnostic.source), "replacements": [replacement]}
        result["fixes"] = [{"artifactChanges": [change]}]
    return result


def _location(at: Diagnostic | Related) -> Json:
    place = {"artifactLocation": _file(at.source), "region": _region(at.source, at.span)}
    return {"physicalLocation": place} | ({"message": {"text": at.label}} if at.label else {})


def _file(source: Source) -> Json:
    path = PurePath(source.path)
    uri = quote(path.as_posix(), errors="backslashreplace")
    return {"uri": f"file://{uri}" if path.is_absolute() else uri}


def _region(source: Source, span: Span) -> Json:
    line, column = source.position(span.start)
    end_line, end_column = source.position(span.end)
    return {"startLine": line, "startColumn": column, "endLine": end_line, "endColumn": end_column}
