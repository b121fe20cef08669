"""The text of a plan file, and the TOML in it."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..domain.errors import BadInput

LARGEST = 1 << 20
"""Bytes. A plan is written by people: anything larger is another file."""

MOST = 100
"""Parts of one key: `tomllib` copies for each part all before it. A plan's longest key has two."""

_PART = r"""(?:[A-Za-z0-9_-]++|"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')"""
_NEXT = rf"(?:[ \t]*\.[ \t]*{_PART})"
_KEY = re.compile(rf"{_PART}({_NEXT}{{{MOST}}})?{_NEXT}*+")
_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")

_UNREADABLE: dict[type[Exception], str] = {
    FileNotFoundError: "there is no such file",
    IsADirectoryError: "is a folder, not a file",
    PermissionError: "may not be read: its permissions forbid it",
    ValueError: "is not a file name",  # a NUL in it
}


def line_of_long_key(text: str) -> int | None:
    """Return the line, from 1, of a key with too many parts; None where there is none."""
    long = next((key.start() for key in _KEY.finditer(text) if key[1]), None)
    return None if long is None else text.count("\n", 0, long) + 1


def text_of(path: Path, opener: Callable[[str, int], int] | None = None) -> str:
    """Return the text of a plan file; raise `BadInput` if it cannot be one."""
    try:
        with open(path, "rb", opener=opener) as file:
            content = file.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        why = (
            _UNREADABLE.get(type(error))
            or f"cannot be read: {getattr(error, 'strerror', None) or error}"
        )
        raise BadInput(f"{path}: {why}") from None
    if len(content) > LARGEST:
        raise BadInput(f"{path}: is larger than {LARGEST // 1024} KiB: this is not a plan file")
    try:
        return content.decode("utf-8-sig")  # some editors put a byte-order mark before the text
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise BadInput(f"{path}:{line}: is not UTF-8 text") from None


def parsed(path: object, text: str) -> dict[str, Any]:
    """Return the data of a plan file's text; raise `BadInput` if it is not TOML."""
    try:
        if line := line_of_long_key(text):
            path = f"{path}:{line}"
            raise RecursionError
        return tomllib.loads(text)
    except RecursionError:
        raise BadInput(f"{path}: is nested too deep") from None
    except ValueError as error:  # TOMLDecodeError, and a number with thousands of digits
        said, end = f"{error}", ""
        if place := _PLACE.search(said):
            path = f"{path}:{place[1] or len(text.splitlines())}"
            end = f", column {place[2]}" if place[2] else ", at the end of the file"
            said = said[: place.start()]
        said = f"is not valid TOML: {said[:1].lower()}{said[1:]}{end}"
        raise BadInput(f"{path}: {said}") from None
