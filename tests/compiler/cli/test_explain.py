"""`plutoc explain`, as a person calls it."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.explain.pages import GROUPS, codes, page
from tests.compiler.cli.conftest import Call


@pytest.mark.parametrize("code", codes())
def test_a_page_is_printed_whole(plutoc: Call, code: str) -> None:
    """Every line of it, without the marks of Markdown."""
    said = plutoc("explain", code)
    assert (said.code, said.err) == (0, "")
    assert said.out.startswith(f"{code}: {page(code).title}\n")
    assert "```" not in said.out
    assert words(said.out) == words(page(code).text)


def words(text: str) -> list[str]:
    """Return what is in the lines, without marks and margins."""
    lines = (line.lstrip("# ") for line in text.splitlines() if not line.startswith("```"))
    return [line for line in lines if line]


def test_an_example_is_indented(plutoc: Call) -> None:
    """It can be told from the text."""
    assert "\nRefused\n\n    pluto 1\n\n    app" in plutoc("explain", "P1003").out


@pytest.mark.parametrize("asked", ["p1003", "1003", " P1003 "])
def test_small_letters_and_bare_numbers_will_do(plutoc: Call, asked: str) -> None:
    """The same page comes out."""
    assert plutoc("explain", asked) == plutoc("explain", "P1003")


def test_alone_it_lists_all_codes(plutoc: Call) -> None:
    """A line each with its title, in order, under what they are about."""
    said = plutoc("explain")
    assert (said.code, said.err) == (0, "")
    listed = [line for line in said.out.splitlines() if line.startswith("  ")]
    assert listed == [f"  {code}  {page(code).title}" for code in codes()]
    assert GROUPS["P1"] in said.out.splitlines()


def test_an_unknown_code_ends_with_2_and_names_near_ones(plutoc: Call) -> None:
    """The one that was meant is among them."""
    said = plutoc("explain", "P10003")
    assert (said.code, said.out) == (2, "")
    assert "there is no code `P10003`; did you mean" in said.err
    assert "P1003" in said.err
    assert plutoc("explain", "nonsense").err == (
        "plutoc: there is no code `nonsense`: `plutoc explain` lists them\n"
    )


def test_what_was_asked_cannot_act_on_the_terminal(plutoc: Call) -> None:
    """An escape character is shown, not sent."""
    assert "\033" not in plutoc("explain", "\033[2J").err


def test_colour_follows_the_usual_variables(plutoc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    """FORCE_COLOR paints headings; NO_COLOR wins; without either, files and pipes stay plain."""
    plain = plutoc("explain", "P1003").out
    assert "\033" not in plain
    monkeypatch.setenv("FORCE_COLOR", "1")
    painted = plutoc("explain", "P1003").out
    assert painted.startswith("\033[1mP1003: ")
    assert "\033[1m" in plutoc("explain").out
    monkeypatch.setenv("NO_COLOR", "1")
    assert plutoc("explain", "P1003").out == plain


def test_a_report_ends_with_how_to_read_more(plutoc: Call, here: Path) -> None:
    """Once, for the first of its diagnostics; programs are not told."""
    (here / "a.pluto").write_text("app a {\n  end = Clock\n}\n")
    assert plutoc("check", "a.pluto").err.endswith("\n`plutoc explain P0009` tells more\n")
    said = plutoc("check", "a.pluto", "--format", "json")
    assert "plutoc explain" not in said.out + said.err
