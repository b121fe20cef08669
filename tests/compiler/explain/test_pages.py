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
    write,
)

CODES = [code for code in codes() if code not in WITHOUT_EXAMPLES]
SEVERITY = {"Refused": "error", "Warned": "warning"}


EXAMPLES = [
    pytest.param(code, mended, id=f"{code}-{'mended' if mended else 'failing'}")
    for code in CODES
    for mended in (False, True)
]
TYPED = [one for one in EXAMPLES if example(str(one.values[0]), mended=bool(one.values[1])).console]
"""Those that are typed: the app alone does not show it."""
ALONE = [one for one in EXAMPLES if one not in TYPED]


@pytest.mark.parametrize(("code", "mended"), ALONE)
def test_an_example_gives_its_code_and_no_other_and_nothing_once_it_is_mended(
    code: str, mended: bool, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Warnings count as well."""
    expected = set() if mended else {(SEVERITY[headings(code)[0]], code)}
    assert said_of(example(code, mended=mended), tmp_path, capfd) == expected


@pytest.mark.long  # real shells; the sessions of tests/compiler/cli/sessions have most of these codes
@pytest.mark.parametrize(("code", "mended"), TYPED)
def test_a_session_gives_its_code_and_no_other_and_nothing_once_it_is_mended(
    code: str, mended: bool, tmp_path: Path
) -> None:
    """Where the app alone does not show it, what the page types is typed in."""
    shown = example(code, mended=mended)
    folder = tmp_path / "work"
    folder.mkdir()
    write(shown, folder)
    ended, said = type_in(shown.console or "", folder, tmp_path / "programs")
    assert set(CODE.findall(said)) == (set() if mended else {code}), said
    assert ended == 0 or not mended, said


@pytest.mark.parametrize("code", CODES)
def test_a_mended_example_is_in_canonical_form(code: str) -> None:
    """What people copy from a page is as `plutoc fmt` writes it."""
    text = example(code, mended=True).files["app.pluto"]
    assert format_source(Source("app.pluto", text)) == text
