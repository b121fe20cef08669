"""Texts of a missions file with `{column}`, into which the values of a list's row are put."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..shared.domain.values import KeyPath

_PART = re.compile(r"\{\{|\}\}|\{([^{}]*)\}|[{}]")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_LONGEST = 40
"""In characters: a longer number is a slip, and Python may refuse to read it."""
_WORDS = {"true": True, "false": False}


class Filled(str):
    """A text with values of a row: where a number, true or false is wanted, it is read as one."""

    columns: tuple[str, ...] = ()
    """The columns whose values are in it."""


def columns_of(template: object) -> Iterator[tuple[KeyPath, str | None]]:
    """Yield the columns that a template names, each with the path of its text; None: a brace alone."""
    if isinstance(template, str):
        for part in _PART.finditer(template):
            if part[0] not in ("{{", "}}"):
                yield (), None if part[1] is None else part[1].strip()
        return
    pairs: Sequence[tuple[str | int, object]] = ()
    if isinstance(template, dict):
        pairs = [*template.items()]
    elif isinstance(template, list):
        pairs = [*enumerate(template)]
    for key, value in pairs:
        for path, column in columns_of(value):
            yield (key, *path), column


def filled(template: object, row: Mapping[str, str]) -> object:
    """Return a template with the values of a row in its texts."""
    match template:
        case str():
            return _filled(template, row)
        case list():
            return [filled(element, row) for element in template]
        case dict():
            return {key: filled(element, row) for key, element in template.items()}
        case _:
            return template


def _filled(template: str, row: Mapping[str, str]) -> str:
    columns = [column for _, column in columns_of(template) if column is not None]
    text = _PART.sub(lambda part: part[0][0] if part[1] is None else row[part[1].strip()], template)
    if not columns:
        return text
    found = Filled(text)
    found.columns = tuple(dict.fromkeys(columns))
    return found


def values_in(value: object) -> Iterator[object]:
    """Yield a value, and all that is within it."""
    yield value
    inner: Iterable[object] = ()
    if isinstance(value, list):
        inner = value
    elif isinstance(value, dict):
        inner = value.values()
    for one in inner:
        yield from values_in(one)


def is_number(text: str) -> bool:
    """Whether a text is written like a number."""
    plain = text.strip()
    return len(plain) <= _LONGEST and _NUMBER.fullmatch(plain) is not None


def as_numbers(value: object) -> object:
    """Return a value with numbers, true and false instead of a row's texts that are written so."""
    if isinstance(value, list):
        return [as_numbers(element) for element in value]
    if not isinstance(value, Filled):
        return value
    text = value.strip()
    if is_number(text):
        return float(text) if set(text) & set(".eE") else int(text)
    return _WORDS.get(text.lower(), str(value))


def as_texts(value: object) -> object:
    """Return a value with plain texts instead of a row's: what is read of it may be kept."""
    if isinstance(value, list):
        return [as_texts(element) for element in value]
    return str(value) if isinstance(value, Filled) else value
