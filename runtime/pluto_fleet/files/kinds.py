"""Which kind of file something is that a user brings: a plan, a drawing of another program, or none that is taken."""

from __future__ import annotations

import re

from .drawings.feature import GEOJSON, KML, LIST, PLAN, WAYPOINTS, Drawing
from .drawings.places_list import is_list_of_places

_TAKEN = (GEOJSON, KML, PLAN, WAYPOINTS, LIST)

_ON_EARTH = "export its places as GeoJSON or KML, which are taken"
TO_MISSIONS = "it is taken as missions, and by `pluto-fleet map` into a fleet file"
_SHEET = 'save its sheet as "CSV UTF-8"; each = "NAME.csv" in a missions file makes a mission of each row'
_JSON = "write it as docs/files.md has it"
_OTHER = "this is another file"

_SIGNS: tuple[tuple[str, str, str], ...] = (
    (r"PK\x03\x04(?s:.)*xl/", "an Excel workbook", _SHEET),
    (r"PK\x03\x04(?s:.)*opendocument\.spreadsheet", "a spreadsheet of LibreOffice", _SHEET),
    (r"PK\x03\x04(?s:.)*wpmz/", "a flight of DJI (WPML, in a KMZ file)", _ON_EARTH),
    (r"PK\x03\x04(?s:.)*\.kml", "a KMZ file", "unpack it: the KML in it is taken"),
    (r"PK\x03\x04(?s:.)*\.shp", "a shapefile in a zip archive", _ON_EARTH),
    (r"PK\x03\x04", "a zip archive", _OTHER),
    (r"\xd0\xcf\x11\xe0", "a workbook or document of an old Office", _SHEET),
    (r"%PDF|\x89PNG|\xff\xd8\xff|GIF8", "a PDF or a picture", _OTHER),
    (r"\x1f\x8b", "a compressed file", _OTHER),
    (r"SQLite format 3(?s:.){53}GPKG", "a GeoPackage", _ON_EARTH),
    (r"SQLite format 3", "a database, such as a journal", _OTHER),
    (r"\x00\x00\x27\x0a", "a shapefile", _ON_EARTH),
    (r"(?:II[*+]\x00|MM\x00[*+])", "a TIFF picture", "`pluto-fleet map` puts a GeoTIFF on a map"),
    (r".?\x00", "UTF-16, or no text", "save it as UTF-8"),
    (r"QGC WPL", WAYPOINTS, TO_MISSIONS),
    (r'\s*\{(?s:.)*"fileType"\s*:', PLAN, TO_MISSIONS),
    (
        r'\s*\{(?s:.)*"type"\s*:\s*"(?:Feature|(?:Multi)?(?:Point|LineString|Polygon)|GeometryColl)',
        GEOJSON,
        TO_MISSIONS,
    ),
    (r'\s*\{(?s:.)*"type"\s*:\s*"Topology"', "TopoJSON", _ON_EARTH),
    (r'\s*\{(?s:.)*"esriGeometry', "JSON of Esri", _ON_EARTH),
    (r"\s*(?:\{|\[\s*\{)", "JSON", _JSON),
    (r"\s*<(?s:.)*<kml\b|\s*<kml\b", KML, TO_MISSIONS),
    (r"\s*<(?s:.)*<gpx\b|\s*<gpx\b", "GPX", _ON_EARTH),
    (r"\s*<(?:[?!]|\w+[\s>])", "XML or HTML", _OTHER),
    (r"(?:\s+|#[^\n]*\n)*+pluto\s+\d", "the source of an app", "its missions are another file"),
)
"""How the content begins or what is in it, what it is, and what to do; the first that fits counts."""

_KINDS = [(re.compile(sign.encode("latin-1")), what, to_do) for sign, what, to_do in _SIGNS]
_MARK = b"\xef\xbb\xbf"
_LOOKED_AT = 1 << 20
_LONGEST_LINE = 10_000


def drawing_in(text: str) -> Drawing | None:
    """Return what is drawn in a text of another program; None: it is no drawing. Raises `Unusable`."""
    what, _ = _kind(text[:_LOOKED_AT].encode(errors="replace"))
    if what not in _TAKEN:
        return None
    from .drawings.readers import READERS  # most plans are none

    return READERS[what](text)


def is_drawing(content: bytes) -> bool:
    """Return whether a content is a drawing that is taken."""
    return _kind(content[:_LOOKED_AT].removeprefix(_MARK))[0] in _TAKEN


def foreign(content: bytes, wanted: str, *, drawn: bool = True) -> str | None:
    """Return what a content is that is not what is wanted, `TOML` or `CSV`, as a message continues; None: it may be.

    `drawn`: a drawing may be where TOML is wanted.
    """
    start = content[:_LOOKED_AT].removeprefix(_MARK)
    what, to_do = _kind(start)
    if what in _TAKEN and ((drawn and wanted == "TOML") or (wanted, what) == ("CSV", LIST)):
        return None
    if what:
        return f"is {what}, and not {wanted}: {to_do}"
    first = start.lstrip().partition(b"\n")[0]
    is_utf_16 = start.startswith((b"\xff\xfe", b"\xfe\xff"))  # who reads it says so
    if (
        wanted == "TOML"
        and not is_utf_16
        and set(first) & set(b",;\t")
        and not set(first) & set(b"=[]{}#\"'")
    ):
        return (
            'is a list (CSV), and not TOML: a missions file names it, each = "NAME.csv"; one of places has'
            " columns latitude and longitude"
        )
    return None


def _kind(start: bytes) -> tuple[str, str]:
    """Return what begins so, and what to do with it; empty: it may be a plan."""
    for sign, what, to_do in _KINDS:
        if sign.match(start):
            return what, to_do
    if is_list_of_places(start[:_LONGEST_LINE].decode(errors="replace")):
        return LIST, TO_MISSIONS
    return "", ""
