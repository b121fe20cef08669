"""Writing TOML, and the lines of tables, keys and elements, which `tomllib` does not give.

The text has been accepted by `tomllib`, so nothing is checked here.
"""

from __future__ import annotations

import re
import tomllib
from bisect import bisect_right
from collections.abc import Mapping
from contextlib import suppress

from ..shared.domain.values import KeyPath

TomlLines = Mapping[KeyPath, int]
"""The line, from 1, of every table, key and element."""

_BETWEEN = re.compile(r"(?:[ \t\n]|#[^\n]*)*")
_KEY = re.compile(r"""[A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*'""")
_STRING = re.compile(
    r'"""(?:[^\\]|\\.)*?"""(?:"{0,2})'
    r"|'''.*?'''(?:'{0,2})"
    r'|"(?:[^"\\\n]|\\.)*"'
    r"|'[^'\n]*'",
    re.DOTALL,
)
MOST = 100
"""Parts of one key: a plan's have two."""
_PART = r"""(?:[A-Za-z0-9_-]++|"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')"""
_NEXT = rf"(?:[ \t]*\.[ \t]*{_PART})"
_LONG_KEY = re.compile(rf"{_PART}({_NEXT}{{{MOST}}})?{_NEXT}*+")
_BARE = re.compile(r"[^,\]}\n#]+")


def places(text: str) -> TomlLines:
    """Return the line of everything in a TOML text that has a path."""
    scanner = _Scanner(text.replace("\r\n", "\n"))
    with suppress(
        LookupError, ValueError, RecursionError
    ):  # a message without a line is better than none
        scanner.document()
    return scanner.lines


def headers(text: str) -> list[tuple[int, KeyPath]]:
    """Return the line and the path of each `[table]` and `[[table]]` of a TOML text, in their order."""
    scanner = _Scanner(text.replace("\r\n", "\n"))
    scanner.document()
    return scanner.headers


def line_of(where: TomlLines, place: KeyPath) -> int | None:
    """Return the line of a path, or of the nearest thing around it."""
    while place:
        if place in where:
            return where[place]
        place = place[:-1]
    return None


def line_of_long_key(text: str) -> int | None:
    """Return the line, from 1, of a key with too many parts: `tomllib` copies for each all before it."""
    long = next((key.start() for key in _LONG_KEY.finditer(text) if key[1]), None)
    return None if long is None else text.count("\n", 0, long) + 1


class _Scanner:
    def __init__(self, text: str) -> None:
        self.lines: dict[KeyPath, int] = {}
        self.headers: list[tuple[int, KeyPath]] = []
        self._text, self._at = text, 0
        self._starts = [0, *(match.end() for match in re.finditer("\n", text))]
        self._counts: dict[KeyPath, int] = {}

    def document(self) -> None:
        table: KeyPath = ()
        while self._skip():
            if self._take("[["):
                table = self._header(repeated=True)
            elif self._take("["):
                table = self._header(repeated=False)
            else:
                self._pair(table)

    def _header(self, *, repeated: bool) -> KeyPath:
        line = self._line()
        *outer, last = self._keys()
        place: KeyPath = ()
        for key in outer:
            place = (*place, key)
            if place in self._counts:  # [[mission.trip]] belongs to the mission begun last
                place = (*place, self._counts[place])
        place = (*place, last)
        self.lines.setdefault(place, line)
        if repeated:
            self._counts[place] = self._counts.get(place, -1) + 1
            place = (*place, self._counts[place])
            self.lines[place] = line
        self._need("]]" if repeated else "]")
        self.headers.append((line, place))
        return place

    def _pair(self, table: KeyPath) -> None:
        line, place = self._line(), table
        for key in self._keys():
            place = (*place, key)
            self.lines.setdefault(place, line)
        self._need("=")
        self._value(place)

    def _value(self, place: KeyPath) -> None:
        self._skip()
        if self._take("{"):
            while self._skip() and not self._take("}"):
                self._pair(place)
                self._skip()
                self._take(",")
        elif self._take("["):
            position = 0
            while self._skip() and not self._take("]"):
                self.lines[*place, position] = self._line()
                self._value((*place, position))
                position += 1
                self._skip()
                self._take(",")
        elif self._match(_STRING) is None and self._match(_BARE) is None:
            raise LookupError("no value")

    def _keys(self) -> list[str]:
        keys = []
        while True:
            self._skip()
            key = self._match(_KEY)
            if key is None:
                raise LookupError("no key")
            keys.append(next(iter(tomllib.loads(f"{key} = 0"))) if key[0] in "\"'" else key)
            self._skip()
            if not self._take("."):
                return keys

    def _skip(self) -> bool:
        self._match(_BETWEEN)
        return self._at < len(self._text)

    def _match(self, pattern: re.Pattern[str]) -> str | None:
        match = pattern.match(self._text, self._at)
        if match is None:
            return None
        self._at = match.end()
        return match[0]

    def _take(self, text: str) -> bool:
        if not self._text.startswith(text, self._at):
            return False
        self._at += len(text)
        return True

    def _need(self, text: str) -> None:
        if not self._take(text):
            raise LookupError(text)

    def _line(self) -> int:
        return bisect_right(self._starts, self._at)


def toml_text(table: Mapping[str, object]) -> str:
    """Write a whole file."""
    import tomlkit  # only to write

    return tomlkit.dumps(table)


def toml_value(value: object) -> str:
    """Write one value on one line."""
    import tomlkit

    if isinstance(value, dict):
        pairs = [
            f"{tomlkit.key(key).as_string()} = {toml_value(one)}" for key, one in value.items()
        ]
        return f"{{ {', '.join(pairs)} }}" if pairs else "{}"
    if isinstance(value, list):
        return f"[{', '.join(map(toml_value, value))}]"
    return tomlkit.item(value).as_string()
