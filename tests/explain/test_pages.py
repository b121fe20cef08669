"""The page of every code shows what it says: one example that gives the code, and its mending."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.explain.pages import codes
from tests.explain.examples import (
    CODE,
    WITHOUT_EXAMPLES,
    example,
    said_of,
    type_in,
    typed,
    write,
)

CODES = [code for code in codes() if code != WITHOUT_EXAMPLES]
HEADINGS = [("Refused", True), ("Mended", False)]


@pytest.mark.parametrize(("heading", "fails"), HEADINGS, ids=["Refused", "Mended"])
@pytest.mark.parametrize("code", CODES)
def test_an_example_gives_its_code_and_no_other_and_nothing_once_it_is_mended(
    code: str, heading: str, fails: bool, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Warnings count as well. Where the app alone does not show it, the session is typed in."""
    shown = example(code, heading)
    assert "app.pluto" in shown.files
    if shown.console is None:
        assert set(said_of(shown, tmp_path, capfd)) == ({code} if fails else set())
        return
    folder = tmp_path / "work"
    folder.mkdir()
    write(shown, folder)
    done = type_in(typed(shown.console), folder, tmp_path / "programs")
    assert set(CODE.findall(done.stdout)) == ({code} if fails else set()), done.stdout
    assert fails or done.returncode == 0, done.stdout


@pytest.mark.parametrize("code", CODES)
def test_the_two_examples_of_a_page_differ(code: str) -> None:
    """Something was mended."""
    assert example(code, "Refused") != example(code, "Mended")
