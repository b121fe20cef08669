"""Parsing untrusted JSON and numbers: bounded depth, no duplicate keys, finite numbers."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from math import isfinite
from typing import NoReturn

from ..commands import Malformed

DEEPEST = 32
_LARGEST = 2**53
"""The largest integer that is exact in a browser."""

_DIGITS = 15
"""The most digits of a number in an address."""

_TOKEN = re.compile(r'"(?:[^"\\]+|\\.)*+"?|[\[{]|[\]}]', re.DOTALL)
"""A string, also an unterminated one, or a bracket outside of strings."""
_HALF = re.compile(r"\\u[dD][89a-fA-F]")
"""Escapes of surrogates."""


def parsed(body: bytes | str) -> object:
    """Parse a body; raise `Malformed` with what is wrong."""
    try:
        text = body if isinstance(body, str) else body.decode("utf-8")
    except UnicodeDecodeError:
        raise Malformed("what was sent is not UTF-8") from None
    _bound_depth(text)
    try:
        data = json.loads(
            text,
            object_pairs_hook=_once,
            parse_constant=_no_number,
            parse_float=_number,
            parse_int=_whole,
        )
    except Malformed:
        raise
    except ValueError:
        raise Malformed("what was sent is not JSON") from None
    if _HALF.search(text):
        _whole_characters(data)
    return data


def parsed_object(body: bytes | str) -> dict[str, object]:
    """Parse a body that must be an object."""
    data = parsed(body)
    if not isinstance(data, dict):
        raise Malformed("what was sent is not an object in braces")
    return data


def asked_number(query: Mapping[str, str], name: str) -> int:
    """Return a whole number from an address; 0 if there is none."""
    text = query.get(name, "0")
    if not (text.isascii() and text.isdecimal() and len(text) <= _DIGITS):
        raise Malformed(f"{name} must be a whole number")
    return int(text)


def _bound_depth(text: str) -> None:
    """Check the depth of brackets before parsing, to protect the parser."""
    depth = 0
    for found in _TOKEN.finditer(text):
        bracket = found.group()
        if bracket in "[{":
            depth += 1
            if depth > DEEPEST:
                raise Malformed(f"what was sent is nested deeper than {DEEPEST}")
        elif bracket in "]}":
            depth -= 1


def _once(pairs: list[tuple[str, object]]) -> dict[str, object]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise Malformed("what was sent has a name twice in one object")
    return found


def _no_number(text: str) -> NoReturn:
    raise Malformed(f"{text} is not a number that can be flown")


def _number(text: str) -> float:
    value = float(text)
    if not isfinite(value):
        _no_number("a number without end")
    return value


def _whole(text: str) -> int:
    if len(text) > len(str(-_LARGEST)) or abs(int(text)) > _LARGEST:
        _no_number("so large a number")
    return int(text)


def _whole_characters(data: object) -> None:
    try:
        json.dumps(data, ensure_ascii=False).encode("utf-8")
    except UnicodeEncodeError:
        raise Malformed("what was sent has half a character in it") from None
