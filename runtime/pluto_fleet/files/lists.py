"""A list of items: `each = "beds.csv"` makes one mission of each row of a CSV file."""

from __future__ import annotations

import codecs
import csv
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from io import StringIO
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from ..geodesy import LocalPlane
from ..shared.domain import values
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted
from ..shared.domain.values import MOST_TOLD, KeyPath, Read, Table
from .csv_rows import Row, UnusableList, rows_of
from .drawings.feature import Unusable
from .drawings.on_map import metres_of
from .drawings.places_list import has_places, place_in
from .reading import PlanTable, advised, listed, near, text_of

MOST = {"missions": 10_000, "values": 1_000_000, "characters": 10_000_000}
"""What all lists of a file make at most; it is counted before it is made."""
_SAVE = 'save it as "CSV UTF-8"'


class RowTable(PlanTable):
    """A table that was made of a row of a list; what does not depend on the row is told once."""

    row: str
    """Such as `beds.csv, row 3`."""

    def problem(self, text: str, *inside: str | int, is_missing: bool = False) -> None:
        """Note a problem, with the columns whose values are in it."""
        value: Any = self.data
        for part in inside:
            value = value.get(part) if isinstance(value, dict) else None
        cells = [] if text.startswith("unknown key") else _cells_in(value)
        path = (*self.path, *inside)
        if not cells and any(one.path == path and one.text == text for one in self.problems):
            return
        super().problem(f"{text}{_of_cells(cells)}", *inside, is_missing=is_missing)

    def value(self, key: str, read: Read) -> Any:
        """Return what stands under a key, where the values of a row may be numbers, too."""
        return Table.value(self, key, partial(_as_wanted, partial(advised, read)))

    def where(self, key: str) -> str:
        """Say of which row it is, as a message continues."""
        return f", of {self.row}"


def _as_wanted(read: Read, value: object) -> object:
    try:
        return read(as_texts(value))
    except ValueError:
        return read(as_numbers(value))


def _cells_in(value: object) -> list[Filled]:
    """Return the texts in a value into which values of a row were put."""
    return [one for one in values_in(value) if isinstance(one, Filled)]


def _of_cells(cells: Sequence[Filled]) -> str:
    """Say whose values stand in a text; only those that are no numbers, if any are not."""
    odd = [cell for cell in cells if not is_number(cell)] or cells
    columns = [*dict.fromkeys(column for cell in odd for column in cell.columns)]
    if not columns:
        return ""
    said = f"column{'s' if len(columns) > 1 else ''} {' and '.join(map(quoted, columns))}"
    if len(odd) == 1 < len(cells):
        said += f": {quoted(odd[0])}"
    for cell in odd:
        if "," in cell and is_number(cell.replace(",", ".", 1)):
            return f" ({said}; a number has a point: {cell.replace(',', '.')})"
    return f" ({said})"


def each_row(top: PlanTable) -> Iterator[PlanTable]:
    """Yield the missions' tables; of one with `each` a table for each row of its list."""
    left = {**MOST}
    for table in top.tables("mission", needed=True):
        if "each" in table.data:
            yield from _of_rows(table, left)
        else:
            yield table


def _of_rows(table: PlanTable, left: dict[str, int]) -> Iterator[PlanTable]:
    document = table.document
    template = {key: value for key, value in table.data.items() if key != "each"}
    document.is_made = True
    list_ = table.value("each", _beside)
    if list_ is None:
        return
    if document.folder is None:
        said = "lies beside a missions file, and this one is in no folder: start with that file"
        table.problem(f"each {quoted(list_)} {said}, --missions M.toml", "each")
        return
    try:
        text = _text(document.folder / list_)
        rows, odd = rows_of(text, left["missions"], _at_most("missions"))
        rows = rows if odd else _on_map(rows, document.landmarks.plane)
    except (UnusableList, Unusable) as wrong:
        rows = []
        odd = [f"{wrong}"]
    for wrong_row in odd:
        table.problem(f"each {quoted(list_)} {wrong_row}", "each")
    if not rows or odd or not _are_known(table, template, [*rows[0][1]]):
        return
    if len(rows) > 1 and "name" in template and not [*columns_of(template["name"])]:
        such = quoted(f"{template['name']} {{{next(iter(rows[0][1]))}}}")
        said = "name is the same for every row, and names must differ: put a column into it"
        table.problem(f"{said}, such as {such}", "name")
        return
    for what, count in _size(template, rows).items():
        left[what] -= count
        if left[what] < 0:
            said = f"makes too much: {_at_most(what)}"
            table.problem(f"each {quoted(list_)} {said}", "each")
            return
    for number, row in rows:
        data: Any = {key: filled(value, row) for key, value in template.items()}
        known = quoted(data["name"]) if values.is_name(data.get("name")) else number
        of_row = RowTable(document, data, table.path)
        of_row.row = f"{list_}, row {number}"
        of_row.who = f"mission {known} ({of_row.row})"
        yield of_row


def _on_map(rows: list[Row], plane: LocalPlane | None) -> list[Row]:
    """Return rows with x and y, and z if one says how high, of a list that has latitude and longitude."""
    if plane is None or not has_places(rows[0][1]):
        return rows
    places = [place_in(number, row) for number, row in rows]
    found = [metres_of(plane, one.spots[0], one.who) for one in places]
    axes = "xyz"[: max(map(len, found))]
    return [
        (number, {**dict.fromkeys(axes, ""), **dict(zip(axes, map(str, at), strict=False)), **row})
        for (number, row), at in zip(rows, found, strict=True)
    ]


def _size(template: Mapping[str, object], rows: Sequence[Row]) -> dict[str, int]:
    """Return how much becomes of a template with these rows, without making it."""
    each = [*values_in(template)]
    characters = len(rows) * sum(len(one) for one in each if isinstance(one, str))
    for column, times in Counter(column for _, column in columns_of(template) if column).items():
        characters += times * sum(len(row[column]) for _, row in rows)
    return {"missions": len(rows), "values": len(rows) * len(each), "characters": characters}


def _at_most(what: str) -> str:
    return f"all lists of a file make at most {MOST[what]:,} {what}"


def _beside(value: object) -> str:
    """Read the path of a list."""
    name: str = values.name(value).replace("\\", "/")
    parts = PurePosixPath(name).parts
    if ".." in parts or parts[:1] == ("/",) or PureWindowsPath(name).drive:
        raise ValueError(
            "lies elsewhere: a list is in the folder of its missions file, or in one below"
        )
    return name


def _are_known(table: PlanTable, template: Mapping[str, object], columns: Sequence[str]) -> bool:
    """Return whether a list has all columns that a template names; what it has not is reported."""
    before = len(table.document.problems)
    for path, column in columns_of(dict(template)):
        if len(table.document.problems) > before + MOST_TOLD:
            break
        if column is None:
            said = "has a brace that is not one of a pair: a brace itself is written {{ or }}"
            table.problem(f"{_key(path)} {said}", *path)
        elif column not in columns:
            there_is = near(column, columns) or f"; the list has: {listed(columns)}"
            brace = "" if "{" in column else "; a brace itself is written {{"
            said = f"has an unknown column {quoted(column)}{there_is}{brace}"
            table.problem(f"{_key(path)} {said}", *path)
    return len(table.document.problems) == before


def _key(path: KeyPath) -> str:
    return next((str(part) for part in reversed(path) if isinstance(part, str)), "")


def _text(path: Path) -> str:
    try:
        return text_of(path, "CSV")
    except BadInput as error:
        said = re.sub(rf"^{re.escape(str(path))}(:\d+)?: ", "", str(error))
        if isinstance(error.__cause__, UnicodeDecodeError):
            said = f"{said.partition(':')[0]}{_first_odd(error.__cause__)}"
        raise UnusableList(f"cannot be used: {said}") from None


def _first_odd(error: UnicodeDecodeError) -> str:
    """Say in which row the first character is that is not UTF-8, and what to do."""
    content = bytes(error.object)
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return f", from row 1 on: {_SAVE}"
    before = content[: error.start].decode("utf-8-sig")
    row = sum(1 for _ in csv.reader(StringIO(f"{before}.", newline="")))
    line = content[content.rfind(b"\n", 0, error.start) + 1 :].partition(b"\n")[0]
    return f", in row {row}, {quoted(line.decode('cp1252', 'replace').strip())}: {_SAVE}"


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
