"""Each folder of tests/cases is a source and the report that must come out of it.

`pytest tests/test_cases.py --update` rewrites the reports: read the difference before committing.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.compile import analyse, check_hooks
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.report.text import render
from plutoc.source import Source

CASES = Path(__file__).parent / "cases"
FOLDERS = sorted(path.parent for path in CASES.glob("*/app.pluto"))


def diagnostics_of(source: Source, hooks: Source | None) -> tuple[Diagnostic, ...]:
    """Take a source through all phases that have something to say about it."""
    try:
        checked, warnings = analyse(source)
        return warnings + check_hooks(checked, hooks)
    except Rejected as rejected:
        return rejected.diagnostics


def read(path: Path) -> Source | None:
    """Read a file of a case, if it has it."""
    # In bytes: reading as text would hide carriage returns from the parser.
    return Source(path.name, path.read_bytes().decode()) if path.exists() else None


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_report_is_as_expected(folder: Path, update: bool) -> None:
    """A source gives exactly the report beside it."""
    source = read(folder / "app.pluto")
    assert source is not None
    found = diagnostics_of(source, read(folder / "hooks.py"))
    report = render(found, colour=False, limit=100)
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
