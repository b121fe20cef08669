"""The page of every code shows what it says: one example that gives the code, and its mending."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.explain.pages import codes
from plutoc.format.run import format_source
from plutoc.source import Source
from tests.compiler.explain.examples import (
    CODE,
    WITHOUT_EXAMPLES,
    example,
    headings,
    said_of,
    type_in,
    typed,
    write,
)

CODES = [code for code in codes() if code not in WITHOUT_EXAMPLES]
SEVERITY = {"Refused": "error", "Warned": "warning"}


@pytest.mark.parametrize("mended", [False, True], ids=["failing", "mended"])
@pytest.mark.parametrize("code", CODES)
def test_an_example_gives_its_code_and_no_other_and_nothing_once_it_is_mended(
    code: str, mended: bool, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Warnings count as well. Where the app alone does not show it, the session is typed in."""
    shown = example(code, mended=mended)
    if shown.console is None:
        expected = set() if mended else {(SEVERITY[headings(code)[0]], code)}
        assert said_of(shown, tmp_path, capfd) == expected
        return
    folder = tmp_path / "work"
    folder.mkdir()
    write(shown, folder)
    done = type_in(typed(shown.console), folder, tmp_path / "programs", capfd)
    assert set(CODE.findall(done.said)) == (set() if mended else {code}), done.said
    assert done.code == 0 or not mended, done.said


@pytest.mark.parametrize("code", CODES)
def test_the_two_examples_of_a_page_differ(code: str) -> None:
    """Something was mended."""
    assert example(code, mended=False) != example(code, mended=True)


@pytest.mark.parametrize("code", CODES)
def test_a_mended_example_is_in_canonical_form(code: str) -> None:
    """What people copy from a page is as `plutoc fmt` writes it."""
    text = example(code, mended=True).files["app.pluto"]
    assert format_source(Source("app.pluto", text)) == text
