"""Reading a plan file: TOML tables that convert values, and collect all mistakes with their lines."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from ..shared.alone import files
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted, number, percent
from ..shared.domain.values import name, point, shown
from . import errors
from .filled import as_numbers, as_texts, cells_in
from .foreign import foreign
from .toml import TomlLines, TomlPath, line_of, places
from .toml_advice import advice

if TYPE_CHECKING:
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.fields import Field
    from ..shared.domain.model import Point
    from .landmarks import Landmarks
    from .toml import TomlPath


@dataclass(frozen=True, slots=True, kw_only=True)
class Wording:
    """The wording of messages, which differs between a file's author and a user of the station."""

    called: Callable[[str], str]
    """What a key is called."""
    missing: Callable[[str], str]
    """A key that must be there is not."""
    field_missing: Callable[[Field], str]
    """A field of the app's own must be filled in and is not."""
    no_trips: Callable[[], str]
    item_missing: Callable[[str], str]
    """An action that needs an item has none."""


IN_A_FILE = Wording(
    called=str,
    missing=errors.missing,
    field_missing=errors.field_missing,
    no_trips=errors.no_trips,
    item_missing=errors.item_missing,
)


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


@dataclass(frozen=True, slots=True, kw_only=True)
class MadeOfArea:
    """What an area has become."""

    who: str
    trips: int
    metres: float
    """The way from the first place to the last."""
    forbidden: float
    """The share of the area that may not be flown over."""

    @property
    def sentence(self) -> str:
        """All of this for people."""
        way = f"{counted(self.trips, 'trip')}, {number(round(self.metres, 1))} m from the first to the last"
        out = f"; {percent(self.forbidden)} of it may not be flown over"
        return f"{self.who}: {way}" + (out if self.forbidden >= 0.005 else "")


class Document:
    """A parsed plan, and everything that is wrong with it."""

    def __init__(
        self,
        path: str,
        data: dict[str, object],
        find: Callable[[], TomlLines] = dict,
        words: Wording = IN_A_FILE,
    ) -> None:
        """`find` is called for the lines as soon as one is asked for."""
        self.path, self.data, self.words = path, data, words
        self.problems: list[Problem] = []
        self._reported: set[tuple[TomlPath, str]] = set()
        self.areas: list[MadeOfArea] = []
        """What its areas have become."""
        self.swept = 0
        """How many trips its areas have made; a small one counts for more, as it takes its time."""
        self.is_made = False
        """Whether missions, or trips, were made of lists or areas in it."""
        self.text = ""
        """What it was parsed from."""
        self.folder: Path | None = None
        """Where it lies; None: it is no file."""
        self.landmarks: Landmarks | None = None
        """The named places and zones that may stand in it; None: there is no map."""
        self.given: list[Mapping[str, object] | None] = []
        """For each mission its table; None: it was made of a list."""
        self._find = find

    @cached_property
    def _where(self) -> TomlLines:
        return self._find()

    def line(self, place: TomlPath) -> int | None:
        """Return the line of a path."""
        return line_of(self._where, place)

    def problem(self, text: str, place: TomlPath, who: str, near: TomlPath) -> None:
        """Report a problem at a path; `near`: another one whose line is shown in a file."""
        line = self.line(near)
        self._reported.add((place, text))
        self.problems.append(Problem(place=place, who=who, text=text, line=line))

    def has_problem(self, text: str, place: TomlPath) -> bool:
        """Return whether just this was reported before."""
        return (place, text) in self._reported

    def refuse_if_bad(self) -> None:
        """Raise `BadInput` with a line for each problem, if there is one."""
        if self.problems:
            raise BadInput(shortened([f"{self._at(one)}: {one.sentence}" for one in self.problems]))

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
    document = parsed(str(path), text_of(path))
    document.folder = path.parent
    return document


def parsed(path: str, text: str) -> Document:
    """Parse a plan file's text; raise `BadInput` if it is not TOML."""
    document = Document(path, files.parsed(path, text, advice), partial(places, text))
    document.text = text
    return document


def text_of(path: Path, wanted: str = "TOML") -> str:
    """Return the text of a plan file, or of a list, `CSV`; raise `BadInput` if it cannot be one."""
    return decoded(files.content_of(path, _opened), path, wanted)


def decoded(content: bytes, path: object, wanted: str = "TOML") -> str:
    """Return the text of what a user brings from a file; raise `BadInput` if it is another kind of file."""
    other = foreign(content, wanted)
    if other is not None:
        raise BadInput(f"{path}: {other}")
    return files.decoded(content, path)


def _opened(path: str, flags: int) -> int:
    """Open a file without blocking: a pipe without a writer is empty."""
    if not hasattr(os, "O_NONBLOCK"):
        return os.open(path, flags)
    descriptor = os.open(path, flags | os.O_NONBLOCK)
    os.set_blocking(descriptor, True)  # one with a writer is read to its end
    return descriptor


T = TypeVar("T")


class Table:
    """One table of the file, and its name in messages."""

    def __init__(
        self,
        document: Document,
        data: Mapping[str, object],
        place: TomlPath = (),
        who: str = "",
        row: str = "",
    ) -> None:
        """`row`: of which row of a list it was made, such as `beds.csv, row 3`."""
        self.document, self.data, self.place, self.who = document, data, place, who
        self.row = row

    def problem(
        self, text: str, *inside: str | int, near: str | None = None, of_key: bool = False
    ) -> None:
        """Report a problem of this table, or of a key in it.

        For a missing key, `near` is another key whose line is shown. `of_key`: it is wrong whatever
        its value: a list has it in every row, and it is told once.
        """
        place = (*self.place, *inside)
        if self.row:
            cells = [] if of_key else cells_in(self._value(inside))
            if not cells and self.document.has_problem(text, place):
                return  # it does not depend on the row
            text += errors.of_cells(cells)
        self.document.problem(text, place, self.who, (*self.place, near) if near else place)

    def _value(self, inside: Sequence[str | int]) -> object:
        value: Any = self.data
        for part in inside:
            try:
                value = value[part]
            except (LookupError, TypeError):
                return None
        return value

    def called(self, key: str) -> str:
        """Return the name of a key in messages."""
        return self.document.words.called(key)

    def valid_name(self, key: str) -> str | None:
        """Return the name under a key, by which messages call the table, if it is one."""
        word: str | None = None
        with suppress(ValueError):
            word = name(self.data.get(key))
        return word

    def line(self, *inside: str | int) -> int | None:
        """Return the line where something in this table stands."""
        return self.document.line((*self.place, *inside))

    def read(self, key: str, convert: Callable[[object], T], *, required: bool = False) -> T | None:
        """Return the converted value; None if there is none, or none that can be read."""
        if key not in self.data:
            if required:
                self.problem(self.document.words.missing(key), key)
            return None
        value, said = self.data[key], ""
        for given in (as_texts(value), as_numbers(value)) if self.row else (value,):
            try:
                return convert(given)
            except ValueError as error:
                said = f"{self.called(key)} {shown(given)} {error}"
        self.problem(said, key)
        return None

    def position(
        self, key: str, airspace: Airspace | None, height: float, *, required: bool = False
    ) -> Point | None:
        """Return a position, at this height if it has none; report it if it is not on the map."""
        found = self.read(key, self._place, required=required)
        if found is None:
            return None
        x, y, *z = found
        place = x, y, z[0] if z else height
        problem = None if airspace is None else airspace.problem(place)
        if problem is not None:
            self.problem(f"{self.called(key)} {problem}", key)
        return place

    def _place(self, value: object) -> tuple[float, ...]:
        """Read a position, or the name of a place of the map that has some."""
        landmarks = self.document.landmarks
        if not isinstance(value, str) or landmarks is None or not landmarks.places:
            found: tuple[float, ...] = point(value)
            return found
        if value not in landmarks.place:
            raise ValueError(errors.no_such_name("place", value, landmarks.place))
        self.document.is_made = True
        return landmarks.place[value]

    def differs(self, what: str, key: str, word: str, others: dict[str, Table]) -> None:
        """Report a name that another table has."""
        other = others.setdefault(word, self)
        if other is not self:
            self.problem(errors.not_unique(what, word, other.line(key), other.row), key)

    def only(self, keys: Sequence[str], what: str) -> None:
        """Report the keys that are not among these."""
        for key in self.data:
            if key not in keys:
                self.problem(errors.unknown_key(key, keys, what), key, of_key=True)

    def table(self, key: str, header: str = "") -> Table | None:
        """Return the table under a key, if there is one; `header` says how it is written."""
        value = self.data.get(key)
        if value is None:
            return None
        if isinstance(value, dict):
            return Table(self.document, value, (*self.place, key), self.who or f"[{key}]", self.row)
        self.problem(f"{key} {errors.not_a_table(f'[{header or key}]')}", key)
        return None

    def tables(self, key: str, header: str) -> Iterator[Table]:
        """Yield the tables of a list of tables."""
        given = self.data.get(key, [])
        every = given if isinstance(given, list) else []
        wrong = [index for index, one in enumerate(every) if not isinstance(one, dict)]
        if wrong or not isinstance(given, list):
            self.problem(f"{key} {errors.single_table(header)}", key, *wrong[:1])
        for index, element in enumerate(every):
            if isinstance(element, dict):
                yield Table(self.document, element, (*self.place, key, index), self.who, self.row)
