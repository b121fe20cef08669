"""What a module imports, found without its syntax tree.

To carry the runtime along takes the imports of all of its modules, and to parse them takes four
starts of Python. But what they import stands at the beginnings of lines, outside of texts and
comments. Where a line is not as plain as that, nothing is guessed: the tree is asked.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from plutoc.frozen import frozen

_TEXTS = r'"""(?:[^"\\]|\\.|"(?!""))*+"""|"(?:[^"\\\n]|\\.)*+"'
_TOKENS = re.compile(
    rf"{_TEXTS}|{_TEXTS.replace(chr(34), chr(39))}|\#[^\n]*"
    r"|^[ \t]*(?P<whole>import)\b(?P<modules>[^\n]*)"
    r"|^[ \t]*(?P<from>from)(?:[ \t]+|(?=\.))(?P<target>\.*[\w.]*)[ \t]+import[ \t]*"
    r"(?P<names>\([^()]*\)[^\n]*|[^\n(]*)"
    r"|(?P<odd>\bimport\b|\\\n)",  # elsewhere in a line, or on two lines
    re.MULTILINE | re.DOTALL,
)
_COMMENT = re.compile(r"\#[^\n]*")
_NAMES = re.compile(
    r"\s*[A-Za-z_]\w*(?:\s+as\s+\w+)?\s*(?:,\s*[A-Za-z_]\w*(?:\s+as\s+\w+)?\s*)*+,?\s*"
)
_MODULES = re.compile(r"[ \t]+[A-Za-z_][\w.]*(?:[ \t]+as[ \t]+\w+)?[ \t]*")


@frozen
class Written:
    """An import as it stands in a text; without names, that of a whole module."""

    target: str
    names: tuple[str, ...]
    start: int
    """In characters from the beginning of the text."""


def written_imports(text: str) -> list[Written] | None:
    """Return a module's imports, or None where only its tree can tell."""
    found = list(_imports(text))
    return None if None in found else [one for one in found if one is not None]


def _imports(text: str) -> Iterator[Written | None]:
    for token in _TOKENS.finditer(text):
        if token["odd"]:
            yield None
        elif token["from"]:
            yield _of_names(token)
        elif token["whole"]:
            modules = _COMMENT.sub("", token["modules"])
            target = modules.split(" as ")[0].strip()
            plain = _MODULES.fullmatch(modules) is not None
            yield Written(target=target, names=(), start=token.start("whole")) if plain else None


def _of_names(token: re.Match[str]) -> Written | None:
    names = _COMMENT.sub("", token["names"]).strip()
    if names.startswith("(") and names.endswith(")"):
        names = names[1:-1]
    if _NAMES.fullmatch(names) is None:
        return None
    listed = (name.split(" as ")[0].strip() for name in names.split(","))
    return Written(
        target=token["target"],
        names=tuple(name for name in listed if name),
        start=token.start("from"),
    )
