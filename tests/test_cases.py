"""Each folder of tests/cases is a source and the report that must come out of it.

`pytest tests/test_cases.py --update` rewrites the reports: read the difference before committing.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc import registry
from plutoc.check.run import check
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.graph.resolve import resolve
from plutoc.report.text import render
from plutoc.source import Source
from plutoc.syntax.parse import parse

CASES = Path(__file__).parent / "cases"
FOLDERS = sorted(path.parent for path in CASES.glob("*/app.pluto"))


def diagnostics_of(source: Source) -> tuple[Diagnostic, ...]:
    """Take a source through all phases that have something to say about it."""
    try:
        graph, warnings = resolve(parse(source), registry.blocks())
        _, more = check(graph)
    except Rejected as rejected:
        return rejected.diagnostics
    return warnings + more


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_report_is_as_expected(folder: Path, update: bool) -> None:
    """A source gives exactly the report beside it."""
    # In bytes: reading as text would hide carriage returns from the parser.
    text = (folder / "app.pluto").read_bytes().decode()
    report = render(diagnostics_of(Source("app.pluto", text)), colour=False, limit=100)
    expected = folder / "report.txt"
    if update:
        expected.write_text(report, encoding="utf-8")
    assert report == expected.read_text(encoding="utf-8")


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_name_of_a_case_says_its_code(folder: Path) -> None:
    """A case called p1005_… reports P1005: each is there for one diagnostic."""
    code = folder.name.split("_")[0].upper()
    if code[0] == "P" and code[1:].isdigit() and len(code) == 5:
        assert f"[{code}]" in (folder / "report.txt").read_text(encoding="utf-8")


def test_there_are_cases() -> None:
    """The folder was found."""
    assert FOLDERS
