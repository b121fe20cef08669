"""`plutoc explain`: the page of each code, and what reports say of it."""

from __future__ import annotations

from plutoc.explain.pages import codes, page
from tests.kit.command import plutoc


def words(text: str) -> list[str]:
    """Return what is in the lines, without marks and margins."""
    lines = (line.lstrip("# ") for line in text.splitlines() if not line.startswith("```"))
    return [line for line in lines if line]


def test_each_page_is_printed_whole() -> None:
    """Every line of it, without the marks of Markdown."""
    for code in codes():
        said = plutoc("explain", code)
        assert (said.code, said.err) == (0, "")
        assert said.out.startswith(f"{code}: {page(code).title}\n")
        assert "```" not in said.out
        assert words(said.out) == words(page(code).text)


def test_alone_it_lists_all_codes() -> None:
    """A line each with its title, in order, under what they are about."""
    listed = [line for line in plutoc("explain").out.splitlines() if line.startswith("  ")]
    assert listed == [f"  {code}  {page(code).title}" for code in codes()]
