"""Files of other programs, such as a spreadsheet or a plan of QGroundControl: what they are, by their content."""

from __future__ import annotations

import re

_ON_EARTH = "its places are degrees on the Earth, and here they are metres on the map: write those"
_SHEET = 'save its sheet as "CSV UTF-8"; each = "NAME.csv" in a missions file makes a mission of each row'
_JSON = "write it as docs/files.md has it"
_OTHER = "this is another file"

_SIGNS: tuple[tuple[str, str, str], ...] = (
    (r"PK\x03\x04(?s:.)*xl/", "an Excel workbook", _SHEET),
    (r"PK\x03\x04(?s:.)*opendocument\.spreadsheet", "a spreadsheet of LibreOffice", _SHEET),
    (r"PK\x03\x04(?s:.)*\.kml", "a KMZ file", _ON_EARTH),
    (r"PK\x03\x04", "a zip archive", _OTHER),
    (r"\xd0\xcf\x11\xe0", "a workbook or document of an old Office", _SHEET),
    (r"%PDF|\x89PNG|\xff\xd8\xff|GIF8", "a PDF or a picture", _OTHER),
    (r"\x1f\x8b", "a compressed file", _OTHER),
    (r"SQLite format 3", "a database, such as a journal", _OTHER),
    (r".?\x00", "UTF-16, or no text", "save it as UTF-8"),
    (r"QGC WPL", "a list of waypoints of a ground station", _ON_EARTH),
    (r'\s*\{(?s:.)*"fileType"\s*:', "a plan of QGroundControl", _ON_EARTH),
    (
        r'\s*\{(?s:.)*"type"\s*:\s*"(?:Feature|(?:Multi)?(?:Point|LineString|Polygon)|GeometryColl)',
        "GeoJSON",
        _ON_EARTH,
    ),
    (r"\s*(?:\{|\[\s*\{)", "JSON", _JSON),
    (r"\s*<(?s:.)*<kml\b|\s*<kml\b", "KML", _ON_EARTH),
    (r"\s*<(?s:.)*<gpx\b|\s*<gpx\b", "GPX", _ON_EARTH),
    (r"\s*<(?:[?!]|\w+[\s>])", "XML or HTML", _OTHER),
    (r"(?:\s+|#[^\n]*\n)*+pluto\s+\d", "the source of an app", "its missions are another file"),
)
"""How the content begins or what is in it, what it is, and what to do; the first that fits counts."""

_KINDS = [(re.compile(sign.encode("latin-1")), what, to_do) for sign, what, to_do in _SIGNS]
_MARK = b"\xef\xbb\xbf"
_LOOKED_AT = 1 << 20


def foreign(content: bytes, wanted: str) -> str | None:
    """Return what a content is that is not what is wanted, `TOML` or `CSV`, as a message continues; None: it may be."""
    start = content[:_LOOKED_AT].removeprefix(_MARK)
    for sign, what, to_do in _KINDS:
        if sign.match(start):
            return f"is {what}, and not {wanted}: {to_do}"
    first = start.lstrip().partition(b"\n")[0]
    if wanted == "TOML" and set(first) & set(b",;\t") and not set(first) & set(b"=[]{}#\"'"):
        return 'is a list (CSV), and not TOML: a missions file names it, each = "NAME.csv"'
    return None
