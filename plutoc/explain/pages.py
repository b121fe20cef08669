"""The pages as they are installed, `pages/CODE.md` beside this file, and how a terminal shows them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
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


_FOLDER = files("plutoc.explain") / "pages"
_BOLD, _CYAN = "1", "1;36"
_FENCE = "```"
_MARGIN = "    "


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
    """Return the code that is meant by `p1003` or `1003`."""
    code = asked.strip().upper()
    return f"P{code}" if code.isdigit() else code


def render(page: Page, *, colour: bool) -> str:
    """Return a page: headings stand out, examples are indented."""
    return "\n".join(_lines(page.text, colour)) + "\n"


def render_list(pages: Iterable[Page], *, colour: bool) -> str:
    """Return all codes with their titles, group by group."""
    lines: list[str] = []
    group = ""
    for page in pages:
        if page.code[:2] != group:
            group = page.code[:2]
            lines += ([""] if lines else []) + [_paint(GROUPS[group], _BOLD, colour)]
        lines.append(f"  {page.code}  {page.title}")
    return "\n".join(lines) + "\n"


def _lines(text: str, colour: bool) -> Iterator[str]:
    in_example = False
    for line in text.rstrip("\n").split("\n"):
        if line.startswith(_FENCE):
            in_example = not in_example
        elif in_example:
            yield f"{_MARGIN}{line}".rstrip()
        elif line.startswith("# "):
            yield _paint(line[2:], _BOLD, colour)
        elif line.startswith("## "):
            yield _paint(line[3:], _CYAN, colour)
        else:
            yield line


def _paint(text: str, code: str, colour: bool) -> str:
    return f"\033[{code}m{text}\033[0m" if colour else text
