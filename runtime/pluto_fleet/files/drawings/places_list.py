"""A list of places, a CSV file with a place a row: its columns `latitude` and `longitude` make it one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..csv_rows import UnusableList, first_row, rows_of
from .feature import (
    LIST,
    MOST_FEATURES,
    Drawing,
    Feature,
    Kind,
    Unusable,
    called,
    name_in,
    spot,
)

_LATITUDE = ("latitude", "lat")
_LONGITUDE = ("longitude", "lon", "lng", "long")
_NAME = ("name", "label", "title", "id")


def is_list_of_places(text: str) -> bool:
    """Return whether the first line of a text names the columns of one."""
    return has_places(first_row(text))


def has_places(columns: Iterable[str]) -> bool:
    """Return whether there are columns of latitude and longitude."""
    names = {column.lower() for column in columns}
    return not names.isdisjoint(_LATITUDE) and not names.isdisjoint(_LONGITUDE)


def read(text: str) -> Drawing:
    """Return the places; raise `Unusable` with what is wrong."""
    try:
        rows, odd = rows_of(text, MOST_FEATURES, f"at most {MOST_FEATURES:,} are taken")
    except UnusableList as error:
        raise Unusable(str(error)) from None
    if odd:
        raise Unusable(odd[0])
    return Drawing(what=LIST, features=tuple(place_in(number, row) for number, row in rows))


def place_in(number: int, given: Mapping[str, str]) -> Feature:
    """Return the place that a row is; raise `Unusable` if it is none."""
    row = {column.lower(): value for column, value in reversed([*given.items()])}
    name = name_in(_value(row, _NAME))
    who = called("row", number, name)
    heights = {word: _number(row.get(word, ""), who, word) for word in ("height", "altitude")}
    latitude = _number(_value(row, _LATITUDE), who, "latitude")
    longitude = _number(_value(row, _LONGITUDE), who, "longitude")
    at = spot(latitude, longitude, who, **heights)
    said = {key: value for key, value in reversed(row.items()) if value}
    return Feature(kind=Kind.PLACE, who=who, name=name, spots=(at,), said=said)


def _number(text: str, who: str, what: str) -> float | None:
    if not text:
        return None
    try:
        return float(text)
    except ValueError:
        is_height = what in ("height", "altitude")
        said = "a number of metres" if is_height else "a number of degrees"
        advice = (
            "; a number has a point"
            if "," in text
            else f", such as {2.5 if is_height else 47.39774}"
        )
        raise Unusable(f'{who} has a {what} "{text[:60]}", which is not {said}{advice}') from None


def _value(row: Mapping[str, str], names: Iterable[str]) -> str:
    """Return what stands in the column that has one of these names; the first of them that is there counts."""
    return next((row[name] for name in names if name in row), "")
