"""Each folder of tests/compiler/diff/cases is an app before and after a change, and what is said of it.

`pytest tests/compiler/diff --update` rewrites the reports: read the difference before committing.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from plutoc.diff.model import Change, Difference, Importance
from plutoc.report.change_reports import markdown, text
from tests.compiler.diff.pairs import difference
from tests.paths import ROOT

CASES = Path(__file__).parent / "cases"
WHICH = "|".join(importance.value for importance in Importance)
FOLDERS = sorted(path.parent for path in CASES.glob("*/old.pluto"))


def compared(folder: Path) -> Difference:
    """Compare the two apps of a folder."""
    return difference(*(_read(folder / name) for name in ("old.pluto", "new.pluto")))


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_report_is_as_expected(folder: Path, update: bool) -> None:
    """As text and as Markdown."""
    found = compared(folder)
    reports = {"report.txt": text(found, colour=False), "report.md": markdown(found)}
    for name, report in reports.items():
        if update:
            (folder / name).write_text(report, encoding="utf-8")
        assert report == _read(folder / name)


@pytest.fixture(scope="module")
def changes() -> list[Change]:
    """Return all changes of all cases."""
    return [change for folder in FOLDERS for change in compared(folder).changes]


def test_every_kind_of_change_has_a_case_and_a_line_in_the_page(changes: list[Change]) -> None:
    """And of the importance that the page says."""
    page = _read(ROOT / "docs/diff.md")
    told = dict(re.findall(rf"^\| `(\w+)` \| ((?:(?:{WHICH})(?:, )?)+) \|", page, re.MULTILINE))
    found: dict[str, set[str]] = {}
    for change in changes:
        found.setdefault(change.kind, set()).add(change.importance.value)
    assert {kind: ", ".join(sorted(which)) for kind, which in found.items()} == told


def test_the_page_shows_what_is_really_said() -> None:
    """Its first example is a case."""
    page = _read(ROOT / "docs/diff.md")
    assert (
        f"$ plutoc diff old.pluto new.pluto\n{_read(CASES / 'retried' / 'report.txt')}```" in page
    )


def test_every_kind_of_change_that_can_be_told_has_a_case(changes: list[Change]) -> None:
    """No sentence goes unread."""
    words = "".join(_read(path) for path in (ROOT / "plutoc/diff/messages").glob("*.py"))
    told_by = r"(?:kind=|kind(?:, said)? = |_set\(|\btold\(|_fields\(|_route\(|one_sided\()"
    told = re.findall(rf'{told_by}\s*"(\w+)"(?: if is_new else "(\w+)")?', words)
    kinds = [kind for either in told for kind in either if kind]
    assert len(kinds) > 40
    assert {*kinds} == {change.kind for change in changes}


def test_sentences_begin_small_and_end_without_a_full_stop(changes: list[Change]) -> None:
    """As those of the diagnostics do; and what is a name stands in backquotes."""
    for change in changes:
        assert change.sentence[0] in "`abcdefghijklmnopqrstuvwxyz", change.sentence
        assert change.sentence[-1] not in ".!~ ", change.sentence
        assert change.sentence.count("`") % 2 == 0, change.sentence
        assert "~" not in change.sentence
        assert "`-" not in change.sentence, "the name of a block that is gone"
        assert "  " not in change.sentence
