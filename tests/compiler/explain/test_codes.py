"""No code without a page and a case, and no page without a code."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from plutoc.explain.pages import GROUPS, codes, page
from tests.compiler.explain.examples import CODE, WITHOUT_EXAMPLES, example, headings
from tests.paths import ROOT

CASES = sorted(path.parent.name for path in (ROOT / "tests" / "cases").glob("*/app.pluto"))


def docstrings(tree: ast.AST) -> set[ast.Constant]:
    """Return the docstrings of a module: whole statements, and nothing comes of them."""
    return {
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }


def said_in(path: Path) -> Iterator[str]:
    """Yield each code that stands in a text of a module."""
    source = path.read_text(encoding="utf-8")
    if not CODE.search(source):  # most have none, and every worker of pytest reads all of them
        return
    tree = ast.parse(source)
    passed = docstrings(tree)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in passed:
            yield from CODE.findall(node.value)


GIVEN = sorted({code for path in (ROOT / "plutoc").rglob("*.py") for code in said_in(path)})
"""What the compiler can say: all codes that stand anywhere in it."""
FORMS = [["Refused", "Mended"], ["Warned", "Mended"], []]


def test_every_code_has_a_page_and_every_page_a_code() -> None:
    """A new diagnostic needs one; a page goes when its diagnostic goes."""
    assert list(codes()) == GIVEN


@pytest.mark.parametrize("code", [code for code in GIVEN if code not in WITHOUT_EXAMPLES])
def test_every_code_has_a_case(code: str) -> None:
    """A folder of tests/cases; or its page has a session, where no app alone gives it."""
    has_folder = any(case.startswith(f"{code.lower()}_") for case in CASES)
    assert has_folder or (code in codes() and example(code, mended=False).console)


@pytest.mark.parametrize("code", codes())
def test_a_page_has_its_form(code: str) -> None:
    """Code and title first, lines that fit a terminal, then what is refused and what mends it."""
    text = page(code).text
    lines = text.splitlines()
    assert re.fullmatch(rf"# {code}: \S.*[^.\s]", lines[0])
    assert code[:2] in GROUPS
    assert text.endswith("\n")
    assert max(map(len, lines)) <= 100
    assert headings(code) in FORMS
    assert (headings(code) == []) == (code in WITHOUT_EXAMPLES)


INDEX = ROOT / "docs" / "diagnostics.md"
HEAD = """# What the compiler says

Each error and each warning has a code, and each code a page: what it means, why it is so, an example
that gives it and the same example mended. `plutoc explain P1003` prints one, `plutoc explain` this
list. A code never changes its meaning and is never used again.
"""


def section(group: str) -> str:
    """Return the table of the codes that begin alike."""
    rows = [
        f"| [{code}](../plutoc/explain/pages/{code}.md) | {page(code).title} |"
        for code in codes()
        if code.startswith(group)
    ]
    return "\n".join(
        [f"## {group}: {GROUPS[group]}", "", "| code | about |", "|---|---|", *rows, ""]
    )


def test_the_index_is_current(update: bool) -> None:
    """Every page is in it, with its title."""
    groups = [group for group in GROUPS if any(code.startswith(group) for code in codes())]
    text = "\n".join([HEAD, *map(section, groups)])
    if update:
        INDEX.write_text(text, encoding="utf-8")
    assert INDEX.read_text(encoding="utf-8") == text
