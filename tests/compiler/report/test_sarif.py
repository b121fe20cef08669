"""Diagnostics as SARIF, held against the schema of the standard.

`sarif-schema-2.1.0.json` is OASIS's own file, as published with errata 01 of SARIF 2.1.0 at
docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json, byte for byte.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from jsonschema import Draft4Validator

from plutoc.diagnostic import Diagnostic, Fix, Related, Severity, arranged
from plutoc.explain.pages import codes, page
from plutoc.report.sarif import render
from plutoc.source import Source, Span
from tests.test_cases import FOLDERS, diagnostics_of, read

TEXT = Path(__file__).with_name("sarif-schema-2.1.0.json").read_bytes()
VALIDATOR = Draft4Validator(json.loads(TEXT))
URI = re.compile(r"(?:file://)?(?:[A-Za-z0-9._~!$&'()*+,;=@/-]|%[0-9A-F]{2})*")
"""A relative reference, or a path on this machine: no blank, no colon, no letter but ASCII's."""

Json = dict[str, object]


def titled(code: str) -> str | None:
    """The title of a code's page."""
    return page(code).title if code in codes() else None


def rendered(*found: Diagnostic, troubles: tuple[str, ...] = ()) -> Json:
    """Render, validate, and return what a reader gets."""
    text = render(found, troubles, version="1.2.3", title=titled)
    assert text.isascii()
    document: Json = json.loads(text)
    VALIDATOR.validate(document)
    return document


def at(value: object, *steps: str | int) -> object:
    """Return what lies deep in a document."""
    for step in steps:
        if isinstance(value, list) and isinstance(step, int):
            value = value[step]
        else:
            assert isinstance(value, dict), step
            value = value[step]
    return value


def uris(value: object) -> Iterator[str]:
    """Find every address in a document."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key == "uri":
                yield str(inner)
            yield from uris(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from uris(inner)


def finding(path: str = "app.pluto") -> Diagnostic:
    """A finding with everything that one can have."""
    source = Source(path, "pluto 1\n🚁 bad\nother\n")
    return Diagnostic(
        code="P1025",
        severity=Severity.WARNING,
        message="wrong",
        source=source,
        span=Span(10, 13),
        label="here",
        related=(Related(source=source, span=Span(14, 19), label="there"),),
        help="mend it",
        fix=Fix(span=Span(9, 13), text=""),
    )


@pytest.mark.parametrize("folder", FOLDERS[::5], ids=lambda folder: folder.name)
def test_what_comes_out_of_a_case_is_valid(folder: Path) -> None:
    """One result a diagnostic, each with the rule that its code names."""
    source = read(folder / "app.pluto")
    assert source is not None
    found = arranged(diagnostics_of(source, read(folder / "hooks.py")))
    document = rendered(*found)
    results = at(document, "runs", 0, "results")
    rules = at(document, "runs", 0, "tool", "driver", "rules")
    assert isinstance(results, list) and isinstance(rules, list)
    assert [result["ruleId"] for result in results] == [d.code for d in found]
    assert [rules[result["ruleIndex"]]["id"] for result in results] == [d.code for d in found]
    assert all(rule["shortDescription"]["text"] == titled(rule["id"]) for rule in rules)
    assert all(URI.fullmatch(uri) for uri in uris(document))


def test_nothing_found_is_a_document_too() -> None:
    """It says that the tool has run and found nothing."""
    document = rendered()
    assert at(document, "runs", 0, "results") == []
    assert at(document, "runs", 0, "tool", "driver", "rules") == []
    assert at(document, "runs", 0, "tool", "driver", "version") == "1.2.3"
    assert at(document, "runs", 0, "invocations") == [{"executionSuccessful": True}]


def test_a_file_that_cannot_be_read_is_a_notification() -> None:
    """The run was no success then."""
    document = rendered(finding(), troubles=("there is no file x",))
    assert at(document, "runs", 0, "invocations", 0) == {
        "executionSuccessful": False,
        "toolExecutionNotifications": [
            {"level": "error", "message": {"text": "there is no file x"}}
        ],
    }


def test_a_result_has_all_the_facts() -> None:
    """Columns count characters: the emoji is one."""
    document = rendered(finding())
    assert at(document, "runs", 0, "columnKind") == "unicodeCodePoints"
    file = {"uri": "app.pluto"}
    assert at(document, "runs", 0, "results", 0) == {
        "ruleId": "P1025",
        "ruleIndex": 0,
        "level": "warning",
        "message": {"text": "wrong\nhelp: mend it"},
        "locations": [
            {"physicalLocation": _place(file, (2, 3, 2, 6)), "message": {"text": "here"}}
        ],
        "relatedLocations": [
            {"id": 1, "physicalLocation": _place(file, (3, 1, 3, 6)), "message": {"text": "there"}}
        ],
        "fixes": [
            {
                "artifactChanges": [
                    {
                        "artifactLocation": file,
                        "replacements": [
                            {"deletedRegion": _region(2, 2, 2, 6), "insertedContent": {"text": ""}}
                        ],
                    }
                ]
            }
        ],
    }


def _place(file: dict[str, str], region: tuple[int, int, int, int]) -> Json:
    return {"artifactLocation": file, "region": _region(*region)}


def _region(line: int, column: int, end_line: int, end_column: int) -> Json:
    return {"startLine": line, "startColumn": column, "endLine": end_line, "endColumn": end_column}


@pytest.mark.parametrize(
    ("path", "uri"),
    [
        ("my apps/field.pluto", "my%20apps/field.pluto"),
        ("../100%.pluto", "../100%25.pluto"),
        ("c:d.pluto", "c%3Ad.pluto"),
        ("würze.pluto", "w%C3%BCrze.pluto"),
        ("/srv/a.pluto", "file:///srv/a.pluto"),
        ("a?b#c.pluto", "a%3Fb%23c.pluto"),
    ],
)
def test_a_path_becomes_an_address(path: str, uri: str) -> None:
    """Relative to where the tool ran, unless it was given from the root."""
    assert set(uris(rendered(finding(path)))) == {uri}
    assert URI.fullmatch(uri)
