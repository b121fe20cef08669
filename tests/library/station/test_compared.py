"""What docs/station-compared.md says of our station is there: each test, file and picture that it names."""

from __future__ import annotations

import re
from pathlib import Path

from tests.paths import ROOT

PAGE = (ROOT / "docs" / "station-compared.md").read_text(encoding="utf-8")
COLUMNS = 6
"""Those of a table that compares; the last one says what shows it."""


def shown_by() -> list[str]:
    """Return the last cell of each row that compares."""
    rows = [line.strip("|").split(" | ") for line in PAGE.splitlines() if line.startswith("| ")]
    last = [cells[-1].strip() for cells in rows if len(cells) == COLUMNS]
    return [cell for cell in last if cell not in ("shown by", "---")]


def place(name: str) -> Path:
    """Return where a test or a file is, by the page's short way of naming it."""
    if name.startswith("tests/"):
        return ROOT / name
    folder = "runtime/pluto_fleet/station" if name.startswith("pages/") else "tests/library/station"
    return ROOT / folder / name


def test_every_row_names_a_test_or_a_file_that_is_there() -> None:
    """And each test that is named stands in its file."""
    rows = shown_by()
    assert len(rows) > 30
    missing = []
    for cell in rows:
        named = re.findall(r"`([^`]+)`", cell)
        assert named, cell
        for name in named:
            path, _, test = name.partition("::")
            found = place(path)
            if not found.exists() or (test and f"def {test}(" not in found.read_text("utf-8")):
                missing.append(name)
    assert missing == []
