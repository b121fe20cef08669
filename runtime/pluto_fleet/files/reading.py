"""A plan's file as data, in which everything has its line; the brain's functions read it (`shared/alone/files.py`)."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property, partial
from pathlib import Path
from typing import Any, cast

from ..shared.domain import values
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted, cut_off, number, percent, printable, quoted
from ..shared.domain.values import KeyPath, Keys, Problem, Read, Table, shortened
from .advice import advice
from .drawings.feature import Drawing, Unusable
from .kinds import TO_MISSIONS, drawing_in, foreign, is_drawing
from .landmarks import NO_LANDMARKS
from .toml import TomlLines, line_of, line_of_long_key, places

LARGEST = 1 << 20
"""In bytes: a plan is written by people, and anything larger is another file."""
LARGEST_DRAWING = 8 << 20
ELSEWHERE = {
    "mission": ("safe_time", "repeat", "evaluator", "at", "every"),
    "trip": ("delay", "priority", "gap"),
}
"""Fields that other apps have: the message says why this app has none."""

_SOME = 10
_MOST_LISTED = 100
_LONGEST_HINT = 100
"""Words that are listed of too many, so many are too many; characters of one that is compared with others."""
_LONG = re.compile(r"(?<![.\w])\d[\d_]{600}")  # a number that Python may refuse to read
_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")
_UNREADABLE: dict[type[Exception], str] = {
    FileNotFoundError: "there is no such file",
    IsADirectoryError: "is a folder, not a file",
    PermissionError: "may not be read: its permissions forbid it",
    ValueError: "is not a file name",  # a NUL in it
}


LEAST_TOLD = 0.5
"""Metres that a way leads over what is not of its area."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MadeOfArea:
    """What an area has become."""

    who: str
    trips: int
    places: int
    """At which its action is done; more than trips, if that is done on the way."""
    metres: float
    """The way from the first place to the last."""
    outside: float
    """Of that, what is not over the area."""
    forbidden: float
    """The share of the area that may not be flown over."""

    @property
    def sentence(self) -> str:
        """All of this for people."""
        trips = counted(self.trips, "trip")
        if self.places > self.trips:
            trips += f" with {self.places} places on the way"
        way = f"{trips}, {number(round(self.metres, 1))} m from the first to the last"
        if self.outside >= LEAST_TOLD:
            way += f", {number(round(self.outside, 1))} m of them not over the area"
        out = f"; {percent(self.forbidden)} of it may not be flown over"
        return f"{self.who}: {way}" + (out if self.forbidden >= 0.005 else "")


class Document:
    """A plan, its text, everything that is wrong with it, and what its areas and lists have become."""

    def __init__(self, name: str, data: Mapping[str, Any], text: str = "") -> None:
        """`name`: of its file; empty: it is none."""
        self.name = name
        self.data = data
        self.text = text
        self.problems: list[Problem] = []
        self.drawing: Drawing | None = None
        """What another program has drawn, which becomes missions; None: it is a plan of ours."""
        self.notes: list[str] = []
        """What of a drawing was left out."""
        self.folder: Path | None = None
        """Where it lies; None: it is no file."""
        self.landmarks = NO_LANDMARKS
        """The named places and zones that may stand in it."""
        self.areas: list[MadeOfArea] = []
        self.swept = 0
        """How many trips its areas have made; a small one counts for more, as it takes its time."""
        self.is_made = False
        """Whether missions, or trips, were made of lists or areas in it."""
        self.given: list[Mapping[str, object] | None] = []
        """For each mission its table; None: it was made of a list."""

    @cached_property
    def _lines(self) -> TomlLines:
        return places(self.text)

    def line(self, path: KeyPath) -> int | None:
        """Return the line of a path."""
        return line_of(self._lines, path)

    def refuse_if_bad(self) -> None:
        """Raise `BadInput` with a line for each problem, if there is one."""
        if self.problems:
            raise BadInput(shortened([self._told(problem) for problem in self.problems]))

    def _told(self, problem: Problem) -> str:
        line = self.line(problem.path)
        place = f"{self.name}:{line}" if line else self.name
        return f"{place}: {problem.sentence}" if place else problem.sentence


class PlanTable(Table):
    """A table of which it is known where it stands, and on what map."""

    def __init__(
        self, document: Document, data: Mapping[str, Any], path: KeyPath = (), who: str = ""
    ) -> None:
        super().__init__(data, path, who)
        self.document = document
        self.problems = document.problems

    def where(self, key: str) -> str:
        """Say in which line a key is, as a message continues."""
        line = self.document.line((*self.path, key))
        return f", in line {line}" if line else ""

    def point(self, value: object) -> Sequence[float]:
        """Read a place, or the name of one on the map."""
        named = self.document.landmarks.place
        if not isinstance(value, str) or not named:
            return cast("Sequence[float]", values.point(value))
        if value not in named:
            raise ValueError(no_such_name("place", value, named))
        self.document.is_made = True
        return named[value]

    def value(self, key: str, read: Read) -> Any:
        """Return what stands under a key; for a wrong word the nearest one is told."""
        return super().value(key, partial(advised, read))

    def unknown(self, key: str, keys: Keys) -> None:
        """Note a key that is none of these, with the nearest of them."""
        hint = near(key, keys)
        kind = next((str(part) for part in self.path[::-1] if isinstance(part, str)), "")
        if key in ELSEWHERE.get("trip" if kind == "area" else kind, ()):
            hint = ": this app's graph has no block that needs it"
        end = " " if hint.endswith("?") else "; "
        self.problem(f"unknown key {quoted(key)}{hint}{end}there may be: {listed(keys)}", key)


def advised(read: Read, value: object) -> object:
    """Read a value; of a wrong word say which one is near."""
    try:
        return read(value)
    except ValueError as error:
        hint = ""
        if isinstance(read, partial) and read.func is values.one_of:
            hint = near(f"{value}", read.args[0])
        raise ValueError(f"{error}{hint}") from None


def near(word: str, words: Iterable[str]) -> str:
    """Return `; did you mean "x"?` if one of the words is near, else nothing."""
    known = [one for one in words if len(one) <= _LONGEST_HINT]
    if len(word) > _LONGEST_HINT or len(known) > _MOST_LISTED:
        return ""  # it would take long
    found = get_close_matches(word, known, 1)
    return f"; did you mean {quoted(found[0])}?" if found else ""


def listed(words: Iterable[str]) -> str:
    """Join words for a message; say so if there are none."""
    found = [*words]
    if len(found) > _MOST_LISTED:
        found = [*found[:_SOME], f"… and {len(found) - _SOME} more"]
    return ", ".join(found) or "none"


def no_such_name(what: str, name: str, names: Iterable[str]) -> str:
    """Say that no place or zone has a name, as a message continues."""
    return f"is no {what} of the map" + (near(name, names) or f"; there are: {listed(names)}")


def top(document: Document, keys: Sequence[str]) -> PlanTable:
    """Return all of a file as a table, which may have these keys."""
    if document.drawing is not None:
        raise BadInput(f"{document.name}: is {document.drawing.what}, and not TOML: {TO_MISSIONS}")
    table = PlanTable(document, document.data)
    table.read({}, dict.fromkeys(keys))
    return table


def read(path: Path) -> Document:
    """Read a plan file; raise `BadInput` if it is no TOML text of a sane size."""
    document = parsed(str(path), text_of(path))
    document.folder = path.parent
    return document


def text_of(path: Path, wanted: str = "TOML") -> str:
    """Return the text of a plan file, or of a list, `CSV`; raise `BadInput` if it cannot be one."""
    try:
        with open(path, "rb", opener=_opened) as file:
            content = file.read(LARGEST_DRAWING + 1)
    except (OSError, ValueError) as error:
        said = f"cannot be read: {getattr(error, 'strerror', None) or error}"
        raise BadInput(f"{path}: {_UNREADABLE.get(type(error), said)}") from None
    return decoded(content, path, wanted)


_DRAWN = (".csv", ".geojson", ".kml", ".plan", ".waypoints")
"""How names of files of other programs end."""


def _opened(path: str, flags: int) -> int:
    """Open a file without blocking: a pipe without a writer is empty."""
    if not hasattr(os, "O_NONBLOCK"):
        return os.open(path, flags)
    descriptor = os.open(path, flags | os.O_NONBLOCK)
    os.set_blocking(descriptor, True)  # one with a writer is read to its end
    return descriptor


def decoded(content: bytes, path: object, wanted: str = "TOML", *, drawn: bool = True) -> str:
    """Return the text of what a user brings from a file; raise `BadInput` if it is another kind of file.

    `drawn`: a drawing of another program will do as well.
    """
    if other := foreign(content, wanted, drawn=drawn):
        raise BadInput(f"{path}: {other}")
    is_drawn = wanted == "TOML" and Path(f"{path}").suffix.lower() in _DRAWN
    if is_drawn and not content.strip():
        raise BadInput(f"{path}: is empty: save it again")
    drawing = is_drawing(content)
    most = LARGEST_DRAWING if drawing else LARGEST
    if len(content) > most:
        said = "leave out what is not flown" if drawing else "this is not a plan file"
        raise BadInput(f"{path}: is larger than {most // 1024} KiB: {said}")
    try:
        return content.decode("utf-8-sig")  # some editors put a byte-order mark before the text
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        kind = " but UTF-16" if content.startswith((b"\xff\xfe", b"\xfe\xff")) else ""
        raise BadInput(f"{path}:{line}: is not UTF-8 text{kind}: save it as UTF-8") from error


def parsed(path: str, text: str) -> Document:
    """Parse a plan file's text, or a drawing's; raise `BadInput` if it is neither."""
    try:
        drawing = drawing_in(text)
    except Unusable as error:
        raise BadInput(f"{path}: {error}") from None
    if drawing is not None:
        document = Document(path, {})
        document.drawing = drawing
        return document
    if line := line_of_long_key(text):
        raise BadInput(f"{path}:{line}: is nested too deep")
    try:
        return Document(path, tomllib.loads(text), text)
    except RecursionError:
        raise BadInput(f"{path}: is nested too deep") from None
    except tomllib.TOMLDecodeError as error:
        raise BadInput(_not_toml(path, text, f"{error}")) from None
    except ValueError:  # Python's own hint is for its programmers
        row = next((n for n, line in enumerate(text.split("\n"), 1) if _LONG.search(line)), 1)
        said = "is not valid TOML: a whole number has too many digits"
        raise BadInput(f"{path}:{row}: {said}") from None


def _not_toml(path: str, text: str, said: str) -> str:
    place = _PLACE.search(said)
    if place is None:
        return f"{path}: is not valid TOML: {said[:1].lower()}{said[1:]}"
    row = int(place[1] or text.rstrip().count("\n") + 1)
    shown = printable(cut_off(text.split("\n")[row - 1].strip(), 80))
    end = f"column {place[2]}" if place[2] else "at the end of the file"
    said = f"{said[:1].lower()}{said[1 : place.start()]}, {end}, in `{shown}`; {advice(text, row)}"
    return f"{path}:{row}: is not valid TOML: {said}"
