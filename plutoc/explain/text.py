"""Pages for a terminal: Markdown without its marks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from plutoc.explain.pages import GROUPS, Page

_BOLD, _CYAN = "1", "1;36"
_FENCE = "```"
_MARGIN = "    "


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
