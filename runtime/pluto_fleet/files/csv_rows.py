"""The rows of a list, a CSV file whose first line names its columns."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from io import StringIO

from ..shared.domain.text import counted, quoted
from ..shared.domain.values import LONGEST_NAME

MOST_COLUMNS = 1_000

LONGEST_VALUE = csv.field_size_limit()
"""In characters."""

_SAID = {
    f"field larger than field limit ({LONGEST_VALUE})": f"a value is longer than {LONGEST_VALUE:,} characters",
    "unexpected end of data": "a quoted value begins there, and no quote ends it",
    "',' expected after '\"'": "something stands behind a quoted value: a quote within one is written twice",
    "';' expected after '\"'": "something stands behind a quoted value: a quote within one is written twice",
}
"""What the module `csv` says, for people."""

Row = tuple[int, Mapping[str, str]]
"""Its number, as a spreadsheet counts, and its values by column."""


class UnusableList(ValueError):
    """What is wrong with a list; the message continues after its name."""


def rows_of(text: str, left: int, at_most: str) -> tuple[list[Row], list[str]]:
    """Return the rows of a list that have values, at least one, and what is wrong with others.

    `left`: how many there may be, which `at_most` says in words. Raises `UnusableList` if it cannot be read as a whole.
    """
    if not text.strip():
        raise UnusableList("is empty: its first line names the columns")
    lines = csv.reader(StringIO(text, newline=""), delimiter=_delimiter(text), strict=True)
    rows: list[Row] = []
    odd: list[str] = []
    columns: list[str] = []
    number = 0
    width = 0
    try:
        for number, cells in enumerate(lines, 1):
            stripped = [cell.strip() for cell in cells]
            if not any(stripped):
                continue
            while not stripped[-1] and len(stripped) > len(columns):
                stripped.pop()  # of a comma at the end
            if not columns:
                columns = _columns(stripped)
                width = len(cells)
                continue
            if len(columns) < len(stripped) <= width:
                raise UnusableList(_nameless(len(columns) + 1))
            if len(stripped) != len(columns):
                odd.append(
                    f"has {counted(len(stripped), 'value')} in row {number}, and its first line"
                    f" names {len(columns)}"
                )
            rows.append((number, dict(zip(columns, stripped, strict=False))))
            if len(rows) > left:
                raise UnusableList(f"has too many rows: {at_most}")
    except csv.Error as error:
        said = _SAID.get(str(error), str(error))
        raise UnusableList(f"cannot be read in row {number + 1}: {said}") from None
    if not rows:
        raise UnusableList("has no row below the one that names its columns")
    return rows, odd


def first_row(text: str) -> list[str]:
    """Return the first line of a text that may be a list, cut into columns."""
    first = text[:LONGEST_VALUE].lstrip().partition("\n")[0]
    if not first:
        return []
    try:
        return [one.strip() for one in next(csv.reader([first], delimiter=_delimiter(first)), [])]
    except csv.Error:
        return []


def _delimiter(text: str) -> str:
    """Return what separates the columns: what splits the first line into more of them."""
    first = next(line for line in text.splitlines() if line.strip())[:LONGEST_VALUE]
    counts = {mark: len(next(csv.reader([first], delimiter=mark), ())) for mark in (",", ";")}
    return ";" if counts[";"] > counts[","] else ","


def _columns(names: Sequence[str]) -> list[str]:
    if len(names) > MOST_COLUMNS:
        raise UnusableList(f"has more than {MOST_COLUMNS:,} columns")
    for place, name in enumerate(names, 1):
        if not name:
            raise UnusableList(_nameless(place))
        if len(name) > LONGEST_NAME:
            raise UnusableList(
                f"has a column {quoted(name)}: its name is longer than {LONGEST_NAME} characters"
            )
        if name in names[: place - 1]:
            raise UnusableList(f"has two columns {quoted(name)}: names must differ")
        if "\t" in name:
            raise UnusableList(
                "has tabs between its columns: separate them by commas or semicolons"
            )
        if set(name) & set("{}"):
            raise UnusableList(f"has a column {quoted(name)}: a column's name has no braces")
    if all(_is_number(name) for name in names):
        raise UnusableList("has no line that names its columns: its first line holds numbers")
    return [*names]


def _nameless(place: int) -> str:
    return f"has no name for its column {place}: its first line names the columns"


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[+-]?[\d.,]+", text) is not None
