"""The page on navigation shows what there is."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import pluto_fleet
from tests.paths import ROOT

DOCS = ROOT / "docs"
PAGE = (DOCS / "navigation.md").read_text()


BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize(("name", "place"), [("wren", 0), ("lines", 1)])
def test_the_page_shows_the_files_as_they_are(name: str, place: int, update: bool) -> None:
    text = (DOCS / f"navigation/{name}.py").read_text()
    code = text.partition("from __future__ import annotations\n\n")[2]
    page = (DOCS / "navigation.md").read_text()
    shown = BLOCK.findall(page)[place]
    if update:
        (DOCS / "navigation.md").write_text(page.replace(shown, code))
    else:
        assert shown == code


@pytest.mark.long
def test_the_test_file_that_the_page_shows_is_one(tmp_path: Path) -> None:
    """As its reader runs it: with pytest, and nothing of ours besides."""
    (tmp_path / "test_wren.py").write_text(BLOCK.findall(PAGE)[2])
    runtime = Path(pluto_fleet.__path__[0]).parent
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-k", "go_to_is_refused or falls_silent", "-rs"],
        cwd=tmp_path,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join(map(str, [DOCS / "navigation", runtime])),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert "1 passed, 1 skipped" in done.stdout, done.stdout + done.stderr
    assert "silence is not given" in done.stdout
