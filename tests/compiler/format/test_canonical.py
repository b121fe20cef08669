"""What the canonical form looks like.

`forms.txt` has what is written, a file or what stands in an app's braces, each line behind a `|`, and its form.
"""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path
from textwrap import dedent, indent

import pytest

from plutoc.diagnostic import Rejected
from tests.format.promises import formatted
from tests.kit.sections import Section, compare, params
from tests.paths import ROOT


def lines_of(text: str) -> str:
    return "\n".join(f"| {line}" for line in text.split("\n"))


@pytest.mark.parametrize("case", params(Path(__file__).with_name("forms.txt")))
def test_what_is_written_has_one_form(case: Section, update: bool) -> None:
    """Blanks where they belong; numbers, units, texts and comments as they were written."""
    text = "\n".join(line.removeprefix("|").removeprefix(" ") for line in case.given.split("\n"))
    if "pluto 1" in text:
        form = formatted(text)
    else:
        head, foot = "pluto 1\n\napp demo {\n", "}\n"
        whole = formatted(f"pluto 1\napp demo {{\n{text}\n}}\n")
        assert whole.startswith(head) and whole.endswith(foot)
        form = dedent(whole.removeprefix(head).removesuffix(foot))
    compare(case, f"-- form\n{lines_of(form)}", update)


def test_line_ends_and_marks_of_other_systems_go() -> None:
    assert formatted("\ufeffpluto 1\r\n\r\n\r\napp a {\r\n}\r\n") == "pluto 1\n\napp a {\n}\n"


def test_mistakes_of_syntax_are_all_reported() -> None:
    """As by `plutoc check`."""
    with pytest.raises(Rejected) as rejected:
        formatted("pluto 1\napp a {\n  b = = K\n  c -> d e\n}\n")
    assert len(rejected.value.diagnostics) == 2


def test_the_starter_is_in_canonical_form() -> None:
    """What `plutoc new` writes needs no `plutoc fmt`."""
    starter = files("plutoc.cli").joinpath("starter", "app.pluto").read_text("utf-8")
    assert formatted(starter) == starter


PAGES = [ROOT / "README.md", ROOT / "docs/language.md", *sorted(ROOT.glob("docs/tutorial/*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_what_the_pages_show_is_in_canonical_form(page: Path) -> None:
    """Whole apps, and pieces of them."""
    shown = re.findall(r"^```(\w*)\n(.*?)^```$", page.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    for language, text in shown:
        if text.startswith("pluto 1\n"):
            assert formatted(text) == text
        elif language == "pluto":
            whole = f"pluto 1\n\napp page {{\n{indent(dedent(text), '  ')}}}\n"
            assert formatted(whole) == whole
