"""`pluto-fleet map`: what another program has drawn is put into the map of a fleet file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..files.drawings.feature import Unusable
from ..files.drawn_map import map_for, map_in, with_drawing
from ..files.geotiff import is_tiff, picture_of
from ..files.reading import read, text_of
from ..files.writing import with_landmarks
from ..process.exit_code import BAD_INPUT
from ..process.whole_file import write_whole
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.text import number, printable
from .options import Options, reader_of

_ABOUT = """Puts what is drawn in a file of another program (GeoJSON, KML, a plan of QGroundControl, a list of places)
into the map of a fleet file: places, areas as zones, and areas where nothing may fly. A fleet file that is not there
is made, with a map as large as what is drawn. A GeoTIFF becomes the picture of the map, where it lies."""


def main(argv: Sequence[str]) -> int:
    """Run the command, and return its exit code."""
    try:
        options = reader_of("map", "pluto-fleet map", _ABOUT).parse_args(argv, namespace=Options())
    except SystemExit as end:  # argparse has printed the help, or what is wrong
        return end.code if isinstance(end.code, int) else BAD_INPUT
    return put(options)


def put(options: Options) -> int:
    """Put what is drawn into the file, and say what that was."""
    fleet = options.fleet
    drawn = options.drawing
    assert fleet is not None  # it is an argument that is needed
    if is_tiff(drawn):
        return put_picture(fleet, drawn)
    drawing = read(drawn).drawing
    if drawing is None:
        raise BadInput(
            f"{drawn}: is a plan of Pluto, and here a drawing of another program is wanted"
        )
    is_new = not os.path.lexists(fleet)
    try:
        text = map_for(drawing) if is_new else text_of(fleet)
        changed, taken = with_drawing(str(fleet), text, drawing, closed=options.no_fly)
    except Unusable as error:
        raise BadInput(f"{drawn}: {error}") from None
    _write(fleet, changed, is_new=is_new)
    for note in taken.notes:
        output.tell(f"{drawn}: warning: {printable(note)}")
    output.line(f"{fleet}: {taken.sentence}")
    if is_new:
        output.line(
            "the file is new: write the ground's height above sea level as its origin's altitude, and"
            " add a [[drone]]"
        )
    return 0


def put_picture(fleet: Path, drawn: Path) -> int:
    """Make a GeoTIFF the picture of the map, beside the file, and say where it lies."""
    text = text_of(fleet)
    airspace, landmarks = map_in(str(fleet), text)
    try:
        content, picture = picture_of(drawn, landmarks.plane)
    except Unusable as error:
        raise BadInput(f"{drawn}: {error}") from None
    file = fleet.parent / picture.file
    if file.exists() and (landmarks.picture is None or landmarks.picture.file != picture.file):
        raise BadInput(f"{file}: is there already, and is not the map's picture: move it away")
    changed = with_landmarks(text, landmarks, replace(landmarks, picture=picture), airspace.size)
    _whole(file, content, 0o644)
    _write(fleet, changed, is_new=False)
    (x, y), (width, height) = picture.at, picture.size
    where = f"[{number(x)}, {number(y)}], {number(width)} × {number(height)} m"
    output.line(
        f"{fleet}: its picture is {picture.file}, from {where}, turned by {number(picture.turn)}°"
    )
    return 0


def _write(fleet: Path, text: str, *, is_new: bool) -> None:
    file = Path(os.path.realpath(fleet))
    _whole(file, text.encode(), 0o644 if is_new else file.stat().st_mode & 0o777)


def _whole(file: Path, content: bytes, mode: int) -> None:
    try:
        write_whole(file, content, mode=mode)
    except OSError as error:
        raise BadInput(f"{file}: it cannot be written: {error.strerror or error}") from None
