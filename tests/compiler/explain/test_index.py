"""docs/diagnostics.md lists the pages. `pytest tests/compiler/explain --update` writes it."""

from __future__ import annotations

from plutoc.explain.pages import GROUPS, codes, page
from tests.paths import ROOT

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
