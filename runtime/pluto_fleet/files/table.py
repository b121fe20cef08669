"""A table of a plan file: it hands out its values, and tells what is wrong with them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, TypeVar

from . import errors

if TYPE_CHECKING:
    from .reading import Document
    from .toml_places import Place

T = TypeVar("T")


class Table:
    """One table of the file, and how a message calls it."""

    def __init__(
        self, document: Document, data: Mapping[str, object], place: Place = (), who: str = ""
    ) -> None:
        self.document, self.data, self.place, self.who = document, data, place, who

    def problem(self, text: str, *inside: str | int, near: str | None = None) -> None:
        """Something is wrong with this table, or with what it holds there.

        What is not there at all is looked for near another key.
        """
        place = (*self.place, *inside)
        self.document.problem(text, place, self.who, (*self.place, near) if near else place)

    def called(self, key: str) -> str:
        """Return what a message calls a key."""
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
        """Tell the keys that are not among these."""
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
