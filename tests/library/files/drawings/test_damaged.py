"""Drawings in which anything stands anywhere: they are taken or refused, and nothing else comes of them."""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path
from random import Random

import pytest

from pluto_fleet.files.drawings.feature import Drawing, Unusable
from pluto_fleet.files.drawn_map import map_for, with_drawing
from pluto_fleet.files.landmarks import Landmarks
from pluto_fleet.files.missions import missions_of
from pluto_fleet.files.reading import decoded, parsed
from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.files.an_app import APP

SHAPES = sorted((Path(__file__).parent / "shapes").iterdir())
PUT_IN = (
    *(b"null", b"true", b"1e400", b"NaN", b"-0", b"9" * 400, b"45.46", b'"x"', b'""', b"[]", b"{}"),
    *(b"[[[[", b"\\ud800", b"\xff", b"\0", b"&#0;", b"\xc3\xa9", b"no fly"),
)
MAP = "[map]\norigin = { latitude = 45.4642, longitude = 9.19 }\nsize = [300, 200]\nceiling = 50\n"


def damaged(content: bytes, chance: Random) -> bytes:
    """Return a file with something else in some places."""
    for _ in range(chance.randint(1, 6)):
        at = chance.randrange(len(content))
        end = at + chance.randint(0, 40)
        numbers = [*re.finditer(rb"-?\d+\.?\d*", content)]
        if numbers and chance.random() < 0.5:
            at, end = chance.choice(numbers).span()
        new = chance.choice((*PUT_IN, b"", content[at:end] * 2))
        content = content[:at] + new + content[end:] or b"x"
    return content


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: str(shape.name))
def test_a_damaged_drawing_is_taken_or_refused(shape: Path) -> None:
    content = shape.read_bytes()
    drawings = list[Drawing]()
    for number in range(400):
        with suppress(BadInput):
            document = parsed("f", decoded(damaged(content, Random(number)), "f"))
            drawings += [document.drawing] if document.drawing else []
            document.landmarks = Landmarks(plane=LocalPlane(45.4642, 9.19))
            missions_of(document, APP, Airspace(size=(300.0, 200.0), ceiling=50.0))
    assert drawings
    for drawing in drawings[::4]:
        with suppress(BadInput, Unusable):
            with_drawing("f", map_for(drawing), drawing, closed=False)
        with suppress(BadInput, Unusable):
            with_drawing("f", MAP, drawing, closed=True)
