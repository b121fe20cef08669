"""Places on the wire and in a file: a browser counts UTF-16 units, and every line end as one.

The file keeps its own line ends, its byte order mark and all its characters.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from functools import cached_property

from plutoc.editor.changes import Edit, Edits, between, in_order, made

_LONGER = re.compile("\r\n|[\U00010000-\U0010ffff]")
_LINE_END = re.compile("\r\n?")
_MARK = "\ufeff"


class NoSuchPlace(Exception):
    """What came over the wire lies outside of the text, or holds half a character."""


class Wire:
    """A file's text, and the same text as a browser has it."""

    def __init__(self, text: str, *, marked: bool = True) -> None:
        self.text = text
        self._skipped = len(_MARK) if marked and text.startswith(_MARK) else 0
        self.shown = _LINE_END.sub("\n", text[self._skipped :])
        """What a browser has."""

    @cached_property
    def _ends(self) -> tuple[list[int], list[int]]:
        """Behind each sign whose lengths differ: the offsets in the file, and on the wire."""
        in_file, on_wire, moved = [self._skipped], [0], -self._skipped
        for match in _LONGER.finditer(self.text, self._skipped):
            moved += -1 if match[0] == "\r\n" else 1
            in_file.append(match.end())
            on_wire.append(match.end() + moved)
        return in_file, on_wire

    @cached_property
    def length(self) -> int:
        """How many units a browser counts."""
        return self.on_wire(len(self.text))

    def on_wire(self, offset: int) -> int:
        """Return where a place of the file is for a browser."""
        in_file, on_wire = self._ends
        offset = min(max(offset, self._skipped), len(self.text))
        last = bisect_right(in_file, offset) - 1
        place = on_wire[last] + offset - in_file[last]
        return min(place, on_wire[last + 1]) if last + 1 < len(on_wire) else place

    def in_file(self, place: int) -> int:
        """Return where a browser's place is in the file; the middle of a character is its end."""
        in_file, on_wire = self._ends
        last = bisect_right(on_wire, place) - 1
        offset = in_file[last] + place - on_wire[last]
        return min(offset, in_file[last + 1]) if last + 1 < len(in_file) else offset

    @property
    def line_end(self) -> str:
        """What ends a line here, as the first line has it."""
        return "\r\n" if re.match(r"[^\n]*\r\n", self.text) else "\n"

    def own(self, text: str) -> str:
        """Return a text with this file's line ends."""
        return _LINE_END.sub("\n", text).replace("\n", self.line_end)

    def received(self, edits: Edits) -> Edits:
        """Return a browser's edits as edits of the file; raise `NoSuchPlace`.

        Two line ends never become one by them: `\\r` and `\\n` would, if they came together.
        """
        edits, found = in_order(edits), []
        for one in edits:
            if not 0 <= one.start <= one.end <= self.length:
                raise NoSuchPlace("a place lies outside of the text")
            start, end = self.in_file(one.start), self.in_file(one.end)
            new = self.own(one.text)
            if self.text[:start].endswith("\r"):
                if new.startswith("\n"):
                    new = "\r" + new
                elif not new and self.text.startswith("\n", end):
                    end, new = end + 1, "\r\n"
            found.append(Edit(start, end, new))
        made_of = in_order(found)
        if Wire(made(self.text, made_of)).shown != self._expected(edits):
            raise NoSuchPlace("the text would not be what the editor shows")
        return made_of

    def _expected(self, edits: Edits) -> str:
        """Return what the browser has after its own edits."""
        units = self.shown.encode("utf-16-le", "surrogatepass")
        parts, done = [], 0
        for one in edits:
            text = _LINE_END.sub("\n", one.text).encode("utf-16-le", "surrogatepass")
            parts += [units[done : one.start * 2], text]
            done = one.end * 2
        try:
            return b"".join([*parts, units[done:]]).decode("utf-16-le")
        except UnicodeDecodeError:
            raise NoSuchPlace("there is half a character in it") from None

    def sent(self, edits: Edits, after: Wire) -> Edits:
        """Return edits of the file, which make the other text of it, as a browser makes them."""
        found = [
            Edit(self.on_wire(one.start), self.on_wire(one.end), _LINE_END.sub("\n", one.text))
            for one in edits
        ]
        if self._expected(tuple(found)) != after.shown:  # half a line end was put in or taken out
            shown = Wire(self.shown, marked=False)
            found = [
                Edit(shown.on_wire(one.start), shown.on_wire(one.end), one.text)
                for one in between(self.shown, after.shown)
            ]
        return tuple(found)


def units(text: str) -> int:
    """Return how long a text is for a browser."""
    return len(text.encode("utf-16-le", "surrogatepass")) // 2
