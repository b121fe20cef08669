"""Writing landmarks into a fleet file: all else in it keeps its bytes, comments and order included.

The file is cut at its headers. Of each part what stands before the end of its last value may be changed;
blank lines and comments behind that belong to what follows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import dropwhile
from typing import TYPE_CHECKING, Any

from ..shared.domain.errors import BadInput
from .landmarks import Picture
from .toml import headers, places, toml_value

if TYPE_CHECKING:
    from ..shared.domain.values import KeyPath
    from .landmarks import Landmarks

_MAP: KeyPath = ("map",)
_IMAGE: KeyPath = ("map", "image")

Table = dict[str, Any]
Size = tuple[float, float]


def landmark_tables(landmarks: Landmarks) -> dict[str, list[Table]]:
    """Return the tables of `places` and of `zones`."""
    return {
        "places": [{"name": one.name, "at": _floats(one.at)} for one in landmarks.places],
        "zones": [
            {"name": one.name, "corners": [_floats(corner) for corner in one.corners]}
            for one in landmarks.zones
        ],
    }


def with_landmarks(text: str, was: Landmarks, landmarks: Landmarks, size: Size) -> str:
    """Return the text of a fleet file whose landmarks `was` are, with others; `size` is that of its map.

    Raises `BadInput` if its map is written so that it cannot be changed without touching the rest.
    """
    if "\r\n" in text and text.count("\n") == text.count("\r\n"):
        return _changed(text.replace("\r\n", "\n"), was, landmarks, size).replace("\n", "\r\n")
    return _changed(text, was, landmarks, size)


@dataclass(slots=True)
class _Part:
    """A header with its values, and what stands between them and the next."""

    path: KeyPath
    lines: list[str]
    rest: list[str]

    def get(self, key: str) -> object:
        """Return the value of a key under this header, or None."""
        import tomlkit  # only to write

        return _under(tomlkit.parse("\n".join(self.lines)), self.path).get(key)

    def put(self, values: Mapping[str, object]) -> None:
        """Set the values of keys; None takes one out."""
        import tomlkit

        document = tomlkit.parse("\n".join(self.lines))
        table, new = _under(document, self.path), []
        for key, value in values.items():
            if value is None:
                table.pop(key, None)
            elif key in table:
                table[key] = tomlkit.value(toml_value(value))
            else:
                new.append(f"{key} = {toml_value(value)}")
        self.lines = [*tomlkit.dumps(document).split("\n"), *new]


def _changed(text: str, was: Landmarks, landmarks: Landmarks, size: Size) -> str:
    parts = _parts(text)
    own = next((part for part in parts if part.path == _MAP), None)
    if own is None:
        if _MAP in places(text):
            raise BadInput("its map has no header of its own: write the line [map] above its keys")
        own = _Part(_MAP, ["[map]"], [""])
        between = [] if text.endswith("\n") else [_Part((), [], [""])]
        parts = [*parts, *between, own] if text else [own]
    own.put(_plain_values(parts, was, landmarks, size))
    old, new = landmark_tables(was), landmark_tables(landmarks)
    last = own
    for key in ("places", "zones"):
        sections = [part for part in parts if part.path[:2] == ("map", key)]
        if own.get(key) is not None:  # they stand in one list
            if old[key] != new[key]:
                own.put({key: new[key]})
            continue
        last = _change_sections(parts, sections, key, old[key], new[key], last)
    return "\n".join(line for part in parts for line in (*part.lines, *part.rest))


def _plain_values(
    parts: Sequence[_Part], was: Landmarks, landmarks: Landmarks, size: Size
) -> Table:
    """Return what is to be set beneath [map]; a picture with a header of its own is set there."""
    values: Table = {} if was.north == landmarks.north else {"north": float(landmarks.north)}
    picture = landmarks.picture
    if picture == was.picture:
        return values
    table: Table | None = None
    if picture is not None:
        table = {"file": picture.file, "at": _floats(picture.at), "size": _floats(picture.size)}
        table["turn"] = float(picture.turn)
    for part in parts:
        if part.path == _IMAGE:
            if table is None:
                part.lines = []
            else:
                part.put(table)
            return values
    fits = picture and picture == Picture(file=picture.file, size=size)
    return {**values, "image": picture.file if picture and fits else table}


def _change_sections(
    parts: list[_Part],
    sections: Sequence[_Part],
    key: str,
    old: Sequence[Table],
    new: Sequence[Table],
    after: _Part,
) -> _Part:
    """Change what stands beneath `[[map.key]]`, new ones behind the others; return the last part of them."""
    wanted, known = {one["name"]: one for one in new}, {one["name"]: one for one in old}
    for part in sections:
        name = part.get("name")
        if name not in wanted:
            before = [
                line for one in parts[: parts.index(part)] for line in (*one.lines, *one.rest)
            ]
            part.lines = []
            if before and _is_blank(before[-1]):
                part.rest = [*dropwhile(_is_blank, part.rest)]
        elif wanted[name] != known[name]:
            part.put(wanted[name])
        after = part
    added = [one for name, one in wanted.items() if name not in known]
    for number, one in enumerate(added):
        lines = [
            f"[[map.{key}]]",
            *(f"{word} = {toml_value(value)}" for word, value in one.items()),
        ]
        part = _Part(("map", key, len(sections) + number), lines, after.rest)
        after.rest = [""] if after.lines else []
        parts.insert(parts.index(after) + 1, part)
        after = part
    return after


def _parts(text: str) -> list[_Part]:
    """Cut a text at its headers; the first part has none."""
    lines, found = text.split("\n"), headers(text)
    starts = [0, *(line - 1 for line, _ in found)]
    paths: list[KeyPath] = [(), *(path for _, path in found)]
    return [
        _part(path, lines[start:end])
        for path, start, end in zip(paths, starts, [*starts[1:], len(lines)], strict=True)
    ]


def _part(path: KeyPath, lines: Sequence[str]) -> _Part:
    end = len(lines)
    while end and (not lines[end - 1].strip() or lines[end - 1].lstrip().startswith("#")):
        end -= 1
    return _Part(path, [*lines[:end]], [*lines[end:]])


def _under(document: Any, path: KeyPath) -> Any:
    """Return the table of a path in a text that has just this one."""
    for step in path:
        document = document[0 if isinstance(step, int) else step]
    return document


def _is_blank(line: str) -> bool:
    return not line.strip()


def _floats(numbers: Sequence[float]) -> list[float]:
    return [float(number) for number in numbers]
