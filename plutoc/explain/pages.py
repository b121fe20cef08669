"""The pages as they are installed: `pages/CODE.md` beside this file."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files

GROUPS = {
    "P0": "Syntax",
    "P1": "Names, types and units",
    "P2": "The graph",
    "P3": "Your hooks",
    "P4": "Writing the package",
    "P9": "Mistakes of ours",
}
"""What the codes that begin so are about."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Page:
    """What there is to know about a code."""

    code: str
    title: str
    text: str
    """The whole page, in Markdown: its first line is the code and the title."""


def codes() -> tuple[str, ...]:
    """Return all codes that have a page, in order."""
    found = (entry.name for entry in _FOLDER.iterdir())
    return tuple(sorted(name.removesuffix(".md") for name in found if name.endswith(".md")))


def page(code: str) -> Page:
    """Return the page of a code, which must be one of `codes()`."""
    text = (_FOLDER / f"{code}.md").read_text(encoding="utf-8")
    title = text.partition("\n")[0].removeprefix(f"# {code}: ")
    return Page(code=code, title=title, text=text)


def code_meant(asked: str) -> str:
    """Return the code that somebody means who writes `p1003` or `1003`."""
    code = asked.strip().upper()
    return f"P{code}" if code.isdigit() else code


_FOLDER = files("plutoc.explain") / "pages"
