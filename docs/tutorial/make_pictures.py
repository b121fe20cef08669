"""Keep the pictures and the quoted files in the pages current: `python docs/tutorial/make_pictures.py`.

A page says what belongs into the fenced block that follows, as a path from the page's folder:

    <!-- graph: app.pluto -->      the app's graph, as `plutoc graph` draws it
    <!-- file: hooks.py -->        the whole file

With `--check` nothing is written, and the exit code is 1 if a page is not current.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from plutoc.compile import analyse
from plutoc.report.pictures import mermaid
from plutoc.source import Source

ROOT = Path(__file__).parents[2]
PAGES = ("docs/*.md", "docs/tutorial/*.md", "examples/*/README.md")

MARK = re.compile(
    r"^<!-- (?P<what>graph|file): (?P<path>\S+) -->\n(?P<open>```\w+\n)(?P<inside>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)


def pages() -> list[Path]:
    """Return every page that may hold a picture."""
    return sorted(page for pattern in PAGES for page in ROOT.glob(pattern))


def refreshed(text: str, folder: Path) -> str:
    """Return a page's text with every marked block as it should be."""

    def refresh(match: re.Match[str]) -> str:
        path = folder / match["path"]
        inside = picture(path) if match["what"] == "graph" else path.read_text(encoding="utf-8")
        return f"<!-- {match['what']}: {match['path']} -->\n{match['open']}{inside}```"

    return MARK.sub(refresh, text)


def picture(path: Path) -> str:
    """Return the graph of an app."""
    checked, _ = analyse(Source(path.name, path.read_text(encoding="utf-8")))
    return mermaid(checked)


def main(arguments: list[str]) -> int:
    """Rewrite the pages that are not current, or only name them."""
    code = 0
    for page in pages():
        old = page.read_text(encoding="utf-8")
        new = refreshed(old, page.parent)
        if new == old:
            continue
        print(f"{page.relative_to(ROOT)} is not current")
        if "--check" in arguments:
            code = 1
        else:
            page.write_text(new, encoding="utf-8")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
