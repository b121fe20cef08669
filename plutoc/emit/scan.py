"""What a module imports, found without its syntax tree.

To carry the runtime along takes the imports of all of its modules, and to parse these takes four
starts of Python. But what they import stands at the beginnings of lines, outside of texts and
comments. Where a line is not as plain as that, nothing is guessed: the tree is asked.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from typing import NamedTuple

_IMPORT = re.compile(r"import\b")
_TEXTS = r'"""(?:[^"\\]++|\\.|"(?!""))*+"""|"(?:[^"\\\n]++|\\.)*+"'
_SKIPPED = re.compile(rf"{_TEXTS}|{_TEXTS.replace(chr(34), chr(39))}|\#[^\n]*", re.DOTALL)
"""Every alternative begins with a sign of its own: so all else is passed over quickly."""
_LINE = re.compile(
    r"[ \t]*(?:import\b(?P<modules>[^\n]*)"
    r"|from(?:[ \t]+|(?=\.))(?P<target>\.*[\w.]*)[ \t]+import\b[ \t]*"
    r"(?P<names>\([^()]*\)[^\n]*|[^\n(]*))"
)
_COMMENT = re.compile(r"\#[^\n]*")
_NAMES = re.compile(
    r"\s*[A-Za-z_]\w*(?:\s+as\s+\w+)?\s*(?:,\s*[A-Za-z_]\w*(?:\s+as\s+\w+)?\s*)*+,?\s*"
)
_PLAIN_NAMES = re.compile(r"\w+(?:, \w+)*")
_MODULES = re.compile(r"[ \t]+[A-Za-z_][\w.]*(?:[ \t]+as[ \t]+\w+)?[ \t]*")
_NESTED = re.compile(r"[fFtT][rR]?[\"']|[rR][fFtT][\"']")


class Written(NamedTuple):
    """An import as it stands in a text; without names, that of a whole module."""

    target: str
    names: tuple[str, ...]
    start: int
    """In characters from the beginning of the text."""


def written_imports(text: str, *, strange: bool = False) -> list[Written] | None:
    """Return a module's imports, or None where only its tree can tell.

    Of a strange text, one that no test of ours has seen, more is in doubt: since Python 3.12, texts
    with expressions in them may hold quotes of their own.
    """
    if "\\\n" in text or (strange and sys.version_info >= (3, 12) and _NESTED.search(text)):
        return None
    found: list[Written] = []
    for one in _imports(text):
        if one is None:
            return None
        found.append(one)
    return found


def _imports(text: str) -> Iterator[Written | None]:
    for at in _in_code(text):
        begin = text.rfind("\n", 0, at) + 1
        line = _LINE.match(text, begin)
        if line is None or not line.start() <= at < line.end():
            yield None  # somewhere else in a line
        elif line["target"] is not None:
            yield _of_names(line)
        else:
            modules = _COMMENT.sub("", line["modules"])
            target = modules.split(" as ")[0].strip()
            plain = _MODULES.fullmatch(modules) is not None
            yield Written(target, (), at) if plain else None


def _in_code(text: str) -> Iterator[int]:
    """Yield where the word `import` stands outside of texts and comments."""
    at = -1
    skipped = ((one.start(), one.end()) for one in _SKIPPED.finditer(text))
    start, end = 0, 0
    while (at := text.find("import", at + 1)) >= 0:
        before = text[at - 1 : at]
        if before.isalnum() or before == "_" or not _IMPORT.match(text, at):
            continue
        while end <= at:
            start, end = next(skipped, (len(text), len(text) + 1))
        if at < start:
            yield at


def _of_names(line: re.Match[str]) -> Written | None:
    start = line.end() - len(line[0].lstrip(" \t"))
    if _PLAIN_NAMES.fullmatch(line["names"]):  # as most are
        return Written(line["target"], tuple(line["names"].split(", ")), start)
    names = _COMMENT.sub("", line["names"]).strip()
    if names.startswith("(") and names.endswith(")"):
        names = names[1:-1]
    if _NAMES.fullmatch(names) is None:
        return None
    listed = (name.split(" as ")[0].strip() for name in names.split(","))
    return Written(line["target"], tuple(name for name in listed if name), start)
