"""What must hold of every source that is formatted."""

from __future__ import annotations

import re

from plutoc.format.canonical import WIDTH
from plutoc.format.run import format_source
from plutoc.source import Source
from plutoc.syntax.parse import parse
from tests.format.layouts import PART


def formatted(text: str) -> str:
    """Format a text."""
    return format_source(Source("app.pluto", text))


def meaning(text: str) -> str:
    """Return the tree of a sound text, without places."""
    file = parse(Source("app.pluto", text))
    return re.sub(r"span=Span\(start=\d+, end=\d+\)", "", repr((file.uses, file.app)))


def writing(text: str) -> list[str]:
    """Return the words and comments of a text in their order; a comma is no word."""
    parts = [part for part in PART.finditer(text) if part.lastgroup != "newline"]
    return [
        part[0].rstrip(" \t") if part.lastgroup == "comment" else re.sub(r"[ \t]", "", part[0])
        for part in parts
        if part[0] != ","
    ]


def alone(text: str) -> list[bool]:
    """Return for each comment whether it must stand on a line of its own.

    A line has room for one comment: of two that stand before and behind one comma, the second is
    moved to the next line.
    """
    parts = [(p.lastgroup if p[0] != "," else "comma") for p in PART.finditer(text)]
    found: list[bool] = []
    for i, kind in enumerate(parts):
        if kind == "comment":
            line = parts[max(i - 1, 0) : i]
            words = [part for part in parts[:i] if part != "newline"]
            moved = line == ["comma"] and words[-2:] == ["comment", "comma"]
            found.append(line in ([], ["newline"]) or moved)
    return found


def keep(text: str, told: str) -> None:
    """Assert that a text keeps every promise of the formatter; `told` is what it means."""
    out = formatted(text)
    assert formatted(out) == out, "it is not idempotent"
    assert meaning(text) == told, "the layout itself is wrong"
    assert meaning(out) == told, "the meaning has changed"
    assert writing(out) == writing(text.replace("\r", "").removeprefix("\ufeff"))
    assert alone(out) == alone(text.replace("\r", "").removeprefix("\ufeff"))
    assert_neat(out)


def assert_neat(out: str) -> None:
    """Assert what can be seen of a formatted text without knowing the source."""
    assert out[0] not in "\n " and out.endswith("\n") and not out.endswith("\n\n")
    assert "\n\n\n" not in out
    assert "\r" not in out
    for line in out.split("\n"):
        assert line == line.rstrip(" \t"), "blanks at the end of a line"
        code = "".join(p[0] for p in PART.finditer(line) if p.lastgroup != "comment")
        assert "\t" not in code
        bare = re.sub(r'"(\\.|[^"])*"', lambda text: "x" * len(text[0]), code)
        breakable = re.search(r"->.*->|[(\[][^)\]]*,", bare)
        assert not breakable or _width(line) <= WIDTH, line
        assert (len(line) - len(line.lstrip(" "))) % 2 == 0


def _width(line: str) -> int:
    """Return how wide a line is without the comment at its end."""
    *_, last = PART.finditer(line)
    return len(line[: last.start()].rstrip() if last.lastgroup == "comment" else line)
