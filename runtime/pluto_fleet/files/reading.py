"""Reading a plan file: TOML tables that convert values, and collect all mistakes with their lines."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from plutoc_runtime.alone.toml import line_of_long_key
from plutoc_runtime.domain.errors import BadInput

from . import errors
from .toml import TomlLines, TomlPath, line_of, places

if TYPE_CHECKING:
    from .toml import TomlPath


@dataclass(frozen=True, slots=True, kw_only=True)
class Wording:
    """The wording of messages, which differs between a file's author and a user of the station."""

    called: Callable[[str], str]
    """What a key is called."""
    missing: Callable[[str], str]
    """A key that must be there is not."""
    no_trips: Callable[[], str]
    item_missing: Callable[[str], str]
    """An action that needs an item has none."""


IN_A_FILE = Wording(
    called=str,
    missing=errors.missing,
    no_trips=errors.no_trips,
    item_missing=errors.item_missing,
)


LARGEST = 1 << 20
"""Bytes. A plan is written by people: anything larger is another file."""

MOST_SHOWN = 50


@dataclass(frozen=True, slots=True, kw_only=True)
class Problem:
    """Something that is wrong with a plan."""

    place: TomlPath
    who: str
    """The subject of the message."""
    text: str
    line: int | None

    @property
    def sentence(self) -> str:
        """The whole message, with its subject."""
        return f"{self.who}: {self.text}" if self.who else self.text


class Document:
    """A parsed plan, and everything that is wrong with it."""

    def __init__(
        self, path: str, data: dict[str, object], where: TomlLines, words: Wording = IN_A_FILE
    ) -> None:
        self.path, self.data, self.words = path, data, words
        self.problems: list[Problem] = []
        self._where = where

    def line(self, place: TomlPath) -> int | None:
        """Return the line of a path."""
        return line_of(self._where, place)

    def problem(self, text: str, place: TomlPath, who: str, near: TomlPath) -> None:
        """Report a problem at a path; `near`: another one whose line is shown in a file."""
        line = self.line(near)
        self.problems.append(Problem(place=place, who=who, text=text, line=line))

    def refuse_if_bad(self) -> None:
        """Raise `BadInput` with a line for each problem, if there is one."""
        if self.problems:
            found = sorted(self.problems, key=lambda problem: problem.line or 0)
            raise BadInput(shortened([f"{self._at(one)}: {one.sentence}" for one in found]))

    def _at(self, problem: Problem) -> str:
        return f"{self.path}:{problem.line}" if problem.line else self.path


def shortened(lines: Sequence[str]) -> str:
    """Join lines, up to a readable number."""
    more = len(lines) - MOST_SHOWN
    if more <= 0:
        return "\n".join(lines)
    return "\n".join([*lines[:MOST_SHOWN], errors.and_more(more)])


def read(path: Path) -> Document:
    """Read a plan file; raise `BadInput` if it is no TOML text of a sane size."""
    return parsed(str(path), text_of(path))


def parsed(path: str, text: str) -> Document:
    """Parse a plan file's text; raise `BadInput` if it is not TOML."""
    line = line_of_long_key(text)
    if line is not None:
        raise BadInput(f"{path}:{line}: {errors.nested_too_deep()}")
    try:
        data = tomllib.loads(text)
    except RecursionError:
        raise BadInput(f"{path}: {errors.nested_too_deep()}") from None
    except ValueError as error:  # TOMLDecodeError, and a number with thousands of digits
        raise BadInput(_syntax(path, text, str(error))) from None
    return Document(path, data, places(text))


def text_of(path: Path) -> str:
    """Return the text of a plan file; raise `BadInput` if it cannot be one."""
    try:
        with open(path, "rb", opener=_opened) as file:
            content = file.read(LARGEST + 1)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise BadInput(f"{path}: {errors.unreadable(error)}") from None
    if len(content) > LARGEST:
        raise BadInput(f"{path}: {errors.too_large(LARGEST)}")
    try:
        return content.decode("utf-8-sig")  # some editors put a byte-order mark before the text
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise BadInput(f"{path}:{line}: {errors.not_utf_8()}") from None


def _opened(path: str, flags: int) -> int:
    """Open a file without blocking: a pipe without a writer is empty."""
    if not hasattr(os, "O_NONBLOCK"):
        return os.open(path, flags)
    descriptor = os.open(path, flags | os.O_NONBLOCK)
    os.set_blocking(descriptor, True)  # one with a writer is read to its end
    return descriptor


def _syntax(path: str, text: str, message: str) -> str:
    place = re.search(r" \(at line (\d+), column (\d+)\)$", message)
    if place is not None:
        return f"{path}:{place[1]}: {errors.syntax(message[: place.start()])}, column {place[2]}"
    shorter = message.removesuffix(" (at end of document)")
    if shorter != message:
        return f"{path}:{len(text.splitlines())}: {errors.syntax(shorter)}, at the end of the file"
    return f"{path}: {errors.syntax(message)}"


T = TypeVar("T")


class Table:
    """One table of the file, and its name in messages."""

    def __init__(
        self, document: Document, data: Mapping[str, object], place: TomlPath = (), who: str = ""
    ) -> None:
        self.document, self.data, self.place, self.who = document, data, place, who

    def problem(self, text: str, *inside: str | int, near: str | None = None) -> None:
        """Report a problem of this table, or of a key in it.

        For a missing key, `near` is another key whose line is shown.
        """
        place = (*self.place, *inside)
        self.document.problem(text, place, self.who, (*self.place, near) if near else place)

    def called(self, key: str) -> str:
        """Return the name of a key in messages."""
        return self.document.words.called(key)

    def line(self, *inside: str | int) -> int | None:
        """Return the line where something in this table stands."""
        return self.document.line((*self.place, *inside))

    def read(self, key: str, convert: Callable[[object], T], *, required: bool = False) -> T | None:
        """Return the converted value; None if there is none, or none that can be read."""
        if key not in self.data:
            if required:
                self.problem(self.document.words.missing(key), key)
            return None
        value = self.data[key]
        try:
            return convert(value)
        except ValueError as error:
            self.problem(f"{self.called(key)} {errors.shown(value)} {error}", key)
            return None

    def only(self, keys: Sequence[str], what: str) -> None:
        """Report the keys that are not among these."""
        for key in self.data:
            if key not in keys:
                self.problem(errors.unknown_key(key, keys, what), key)

    def table(self, key: str, header: str = "") -> Table | None:
        """Return the table under a key, if there is one; `header` says how it is written."""
        value = self.data.get(key)
        if value is None:
            return None
        if isinstance(value, dict):
            return Table(self.document, value, (*self.place, key), self.who or f"[{key}]")
        self.problem(f"{key} {errors.not_a_table(f'[{header or key}]')}", key)
        return None

    def tables(self, key: str, header: str) -> Iterator[Table]:
        """Yield the tables of a list of tables."""
        value = self.data.get(key)
        if value is None:
            return
        if not isinstance(value, list):
            self.problem(f"{key} {errors.single_table(header)}", key)
            return
        for index, element in enumerate(value):
            if isinstance(element, dict):
                yield Table(self.document, element, (*self.place, key, index), self.who)
            else:
                self.problem(f"{key} {errors.single_table(header)}", key, index)
                return
