"""What clients send, read with care: it may be anything."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from math import isfinite
from typing import NoReturn

from plutoc.editor.changes import Edit, Edits
from plutoc.editor.history import File
from plutoc.report.layout import Point
from plutoc.service.picture.positions import FARTHEST, MOST

_DEEPEST = 32
_LARGEST = 2**53
_TOKEN = re.compile(r'"(?:[^"\\]+|\\.)*+"?|[\[{]|[\]}]', re.DOTALL)
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,99}")

Asked = Mapping[str, object]


class Refused(Exception):
    """What was asked cannot be done. The message is a sentence for a person."""


def parsed(message: str) -> Asked:
    """Parse a message; raise `Refused` where it is no object of plain data."""
    depth = 0
    for match in _TOKEN.finditer(message):
        depth += 1 if match[0] in "[{" else -1 if match[0] in "]}" else 0
        if depth > _DEEPEST:
            raise Refused(f"what was sent is nested deeper than {_DEEPEST}")
    try:
        data = json.loads(message, parse_constant=_no_number, parse_int=_whole, parse_float=_number)
    except ValueError:
        raise Refused("what was sent is not JSON") from None
    if not isinstance(data, dict):
        raise Refused("what was sent is no object")
    return data


def _no_number(text: str) -> NoReturn:
    raise Refused(f"{text} is not a number")


def _whole(text: str) -> int:
    if len(text) > len(str(-_LARGEST)) or abs(int(text)) > _LARGEST:
        raise Refused("a number is too large")
    return int(text)


def _number(text: str) -> float:
    value = float(text)
    return value if isfinite(value) else _no_number("infinity")


def text(asked: Asked, name: str) -> str:
    """Return a text; raise `Refused` where there is none."""
    value = asked.get(name)
    if not isinstance(value, str) or _is_broken(value):
        raise Refused(f"{name} must be a text")
    return value


def _is_broken(value: str) -> bool:
    try:
        value.encode()
    except UnicodeEncodeError:  # half a character
        return True
    return False


def number(asked: Asked, name: str, default: int | None = None) -> int:
    """Return a whole number; raise `Refused` where there is none."""
    value = asked.get(name, default)
    if type(value) is not int:
        raise Refused(f"{name} must be a whole number")
    return value


def texts(asked: Asked, name: str) -> list[str]:
    """Return a list of texts."""
    value = asked.get(name, [])
    if not isinstance(value, list) or not all(isinstance(one, str) for one in value):
        raise Refused(f"{name} must be a list of texts")
    return value


def file(asked: Asked) -> File:
    """Return which of the two texts is meant."""
    value = asked.get("file", "app")
    if value not in ("app", "hooks"):
        raise Refused("file must be app or hooks")
    return File.APP if value == "app" else File.HOOKS


def edits(asked: Asked) -> Edits:
    """Return what was typed, as a browser counts."""
    value = asked.get("changes")
    if not isinstance(value, list) or not value:
        raise Refused("changes must be a list of objects")
    found = []
    for one in value:
        if not isinstance(one, dict):
            raise Refused("changes must be a list of objects")
        start, end = number(one, "from"), number(one, "to")
        found.append(Edit(start, end, text(one, "insert")))
    return tuple(found)


def positions(asked: Asked) -> dict[str, Point | None]:
    """Return where blocks were put, by name; None: back to the layout."""
    value = asked.get("positions", {})
    if not isinstance(value, dict) or len(value) > MOST:
        raise Refused("positions must be an object")
    return {name: _position(name, at) for name, at in value.items()}


def _position(name: str, at: object) -> Point | None:
    if name and not _NAME.fullmatch(name):
        raise Refused("positions must be those of blocks")
    match at:
        case None:
            return None
        case [int() | float() as x, int() | float() as y] if max(abs(x), abs(y)) <= FARTHEST:
            return round(x), round(y)
    raise Refused("a position is two numbers, or null")
