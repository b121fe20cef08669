"""Names that may be declared where the source is unreadable, or where a declared name is wrong.

One mistake is told once: a name that such a place may declare is not called unknown elsewhere.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

from plutoc.graph.names import Style, has_style, reserved
from plutoc.syntax.tokens import OWNERS, RESULT, SETTINGS
from plutoc.syntax.tree import BadStatement, BlockDecl, File

_DECLARE_NOTHING = frozenset({"flow", *SETTINGS, *OWNERS, RESULT})
"""They declare no name, even where something is wrong with them."""
_WORD = re.compile(r"\w+")
_ALIKE = 0.6
_MANY = 20
"""Where so much is unclear, nothing is surely unknown."""
_SHORT = 3
"""A name of so many letters is found in most texts by chance."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertainNames:
    """Names that may be declared after all."""

    names: frozenset[str]
    texts: tuple[str, ...]
    """What cannot be read, without all that is in no name."""
    heads: tuple[str, ...]
    """What stands where a name should be declared, and is wrong."""
    beginnings: tuple[str, ...]
    """What is declared in a statement that cannot be read: the name may have more letters."""

    def may_declare(self, name: str) -> bool:
        """Return whether this name may have been meant."""
        if len(self.texts) + len(self.heads) > _MANY:
            return True
        return (
            name in self.names
            or (len(name) > _SHORT and any(name in text for text in self.texts))
            or any(_is_meant(name, head) for head in self.heads)
            or name.startswith(self.beginnings)
        )


def bad_statements(file: File) -> list[BadStatement]:
    """Return all that cannot be read, in order."""
    inside = [each for each in file.app.statements if isinstance(each, BadStatement)]
    return [*file.bad, *inside]


def uncertain_names(file: File, spoilt: Sequence[str]) -> UncertainNames:
    """Collect what may be declared in a file; `spoilt` are declared names that are wrong."""
    bad = [each for each in bad_statements(file) if each.kind not in _DECLARE_NOTHING]
    words = [_WORD.findall(file.source.quote(each.span)) for each in bad]
    return UncertainNames(
        names=frozenset((*chain.from_iterable(words), *_in_place_of_a_kind(file))),
        texts=tuple(dict.fromkeys(map("".join, words))),
        heads=tuple(
            dict.fromkeys((*(each.head for each in bad if each.head is not None), *spoilt))
        ),
        beginnings=tuple(each.name.text for each in bad if each.name and each.kind != "app"),
    )


def _in_place_of_a_kind(file: File) -> list[str]:
    """Return what is written as a name is, and stands where a kind of block should be."""
    return [
        statement.kind.text
        for statement in file.app.statements
        if isinstance(statement, BlockDecl)
        and statement.prefix is None
        and has_style(statement.kind.text, Style.SNAKE)
    ]


def _is_meant(name: str, head: str) -> bool:
    one, other = name.lower(), head.lower()
    from difflib import SequenceMatcher  # only for mistakes

    return not head or bool(reserved(head)) or SequenceMatcher(None, one, other).ratio() >= _ALIKE
