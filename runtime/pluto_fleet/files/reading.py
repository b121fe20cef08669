"""From a path to a TOML document whose problems can be told by line."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from plutoc_runtime.alone.toml import line_of_long_key
from plutoc_runtime.domain.errors import BadInput

from . import errors
from .toml_places import Place, Places, line_of, places
from .wording import IN_A_FILE, Wording

LARGEST = 1 << 20
"""Bytes. A plan is written by people: anything larger is another file."""

MOST_SHOWN = 50


@dataclass(frozen=True, slots=True, kw_only=True)
class Problem:
    """Something that is wrong with a plan."""

    place: Place
    who: str
    """How a message calls what it is about."""
    text: str
    line: int | None

    @property
    def sentence(self) -> str:
        """What is said where nothing else shows what it is about."""
        return f"{self.who}: {self.text}" if self.who else self.text


class Document:
    """A parsed plan and what is wrong with it: all of it, told in one go."""

    def __init__(
        self, path: str, data: dict[str, object], where: Places, words: Wording = IN_A_FILE
    ) -> None:
        self.path, self.data, self.words = path, data, words
        self.problems: list[Problem] = []
        self._where = where

    def line(self, place: Place) -> int | None:
        """Return the line of what has this path."""
        return line_of(self._where, place)

    def problem(self, text: str, place: Place, who: str, near: Place) -> None:
        """Something is wrong at this place; whoever reads a file finds it near another."""
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
    """Join lines for a person: nobody reads the thousandth problem."""
    more = len(lines) - MOST_SHOWN
    if more <= 0:
        return "\n".join(lines)
    return "\n".join([*lines[:MOST_SHOWN], errors.and_more(more)])


def read(path: Path) -> Document:
    """Read a plan file; raise `BadInput` if it is no TOML text of a sane size."""
    return parsed(str(path), text_of(path))


def parsed(path: str, text: str) -> Document:
    """Return what a plan file's text says; raise `BadInput` if it is no TOML."""
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
    """Open a file without waiting: a pipe that nobody writes into is empty."""
    if not hasattr(os, "O_NONBLOCK"):
        return os.open(path, flags)
    descriptor = os.open(path, flags | os.O_NONBLOCK)
    os.set_blocking(descriptor, True)  # one that somebody does write into is read to its end
    return descriptor


def _syntax(path: str, text: str, message: str) -> str:
    place = re.search(r" \(at line (\d+), column (\d+)\)$", message)
    if place is not None:
        return f"{path}:{place[1]}: {errors.syntax(message[: place.start()])}, column {place[2]}"
    shorter = message.removesuffix(" (at end of document)")
    if shorter != message:
        return f"{path}:{len(text.splitlines())}: {errors.syntax(shorter)}, at the end of the file"
    return f"{path}: {errors.syntax(message)}"
