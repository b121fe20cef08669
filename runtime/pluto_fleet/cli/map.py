"""`pluto-fleet map`: what another program has drawn is put into the map of a fleet file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from ..files.drawings.feature import Unusable
from ..files.drawn_map import map_for, with_drawing
from ..files.reading import read, text_of
from ..process.exit_code import BAD_INPUT
from ..process.whole_file import write_whole
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.text import printable
from .options import Options, reader_of

_ABOUT = """Puts what is drawn in a file of another program (GeoJSON, KML, a plan of QGroundControl, a list of places)
into the map of a fleet file: places, areas as zones, and areas where nothing may fly. A fleet file that is not there
is made, with a map as large as what is drawn."""


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


def _write(fleet: Path, text: str, *, is_new: bool) -> None:
    file = Path(os.path.realpath(fleet))
    try:
        write_whole(file, text.encode(), mode=0o644 if is_new else file.stat().st_mode & 0o777)
    except OSError as error:
        raise BadInput(f"{fleet}: it cannot be written: {error.strerror or error}") from None
