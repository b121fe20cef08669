"""KML (OGC 12-007r2), as Google Earth writes it, and many others."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from .feature import (
    KML,
    Drawing,
    Feature,
    Kind,
    Spot,
    Unusable,
    called,
    corners,
    is_no_fly,
    name_in,
    refuse_if_many,
    spot,
)
from .xml import local, tree_of

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element


_BLANKS = "; a place is longitude,latitude,height, without blanks"
_GEOMETRIES = ("Point", "LineString", "LinearRing", "Polygon")
_ODD = {
    "NetworkLink": "links to other files",
    "Track": "recorded tracks",
    "MultiTrack": "recorded tracks",
    "Model": "models in three dimensions",
    "GroundOverlay": "pictures on the ground",
}
"""What is left out, and told."""


def read(text: str) -> Drawing:
    """Return what is drawn; raise `Unusable` with what is wrong."""
    root = tree_of(text, KML)
    if "dji.com/wpmz" in text[:4096]:
        raise Unusable("is a flight of DJI (WPML): export the places as KML, or draw them again")
    found: list[Feature] = []
    for number, (placemark, folders) in enumerate(_placemarks(root, ()), 1):
        found += _features(placemark, folders, number)
    refuse_if_many(found)
    odd = [_ODD[name] for one in root.iter() if (name := local(one.tag)) in _ODD]
    notes = [f"{what} are left out: {odd.count(what)}" for what in dict.fromkeys(odd)]
    if not found and odd:
        raise Unusable(f"has no places of its own, but {' and '.join(dict.fromkeys(odd))}")
    return Drawing(what=KML, features=tuple(found), notes=tuple(notes))


def _placemarks(
    element: Element, folders: tuple[str, ...]
) -> Iterator[tuple[Element, tuple[str, ...]]]:
    """Yield the placemarks, each with the names of the folders that it is in."""
    for one in element:
        if local(one.tag) == "Placemark":
            yield one, folders
        elif local(one.tag) in ("Document", "Folder"):
            yield from _placemarks(one, (*folders, _text(one, "name") or ""))


def _features(placemark: Element, folders: Sequence[str], number: int) -> Iterator[Feature]:
    name = name_in(_text(placemark, "name"))
    who = called("placemark", number, name)
    said = dict(_data(placemark))
    forbidden = said.get("no_fly", "").lower() in ("true", "1", "yes")
    forbidden = forbidden or is_no_fly(name, *folders)
    for geometry in _geometries(placemark):
        yield _feature(geometry, who, name, said, forbidden=forbidden)


def _geometries(element: Element) -> Iterator[Element]:
    for one in element:
        if local(one.tag) in _GEOMETRIES:
            yield one
        elif local(one.tag) == "MultiGeometry":
            yield from _geometries(one)


def _data(placemark: Element) -> Iterator[tuple[str, str]]:
    """Yield what a placemark says of itself, typed or not."""
    for one in placemark.iter():
        key = one.get("name")
        if local(one.tag) == "Data" and key:
            yield key, (_text(one, "value") or "").strip()
        elif local(one.tag) == "SimpleData" and key:
            yield key, (one.text or "").strip()


def _feature(
    geometry: Element, who: str, name: str | None, said: dict[str, str], *, forbidden: bool
) -> Feature:
    kind = local(geometry.tag)
    if kind == "Polygon":
        around = _child(geometry, "outerBoundaryIs")
        ring = None if around is None else _child(around, "LinearRing")
        if ring is None:
            raise Unusable(f"{who} has no outline")
        return Feature(
            kind=Kind.NO_FLY if forbidden else Kind.AREA,
            who=who,
            name=name,
            spots=corners(_spots(ring, geometry, who), who),
            has_holes=_child(geometry, "innerBoundaryIs") is not None,
            said=said,
        )
    spots = _spots(geometry, geometry, who)
    if not spots:
        raise Unusable(f"{who} has no coordinates")
    what = Kind.PLACE if kind == "Point" else Kind.ROUTE
    return Feature(kind=what, who=who, name=name, spots=spots, said=said)


def _spots(holder: Element, geometry: Element, who: str) -> tuple[Spot, ...]:
    """Return the coordinates: `longitude,latitude,height` apart by blanks."""
    mode = _text(geometry, "altitudeMode") or "clampToGround"
    found = []
    for one in (_text(holder, "coordinates") or "").split():
        try:
            longitude, latitude, *more = map(float, one.split(","))
        except ValueError:
            raise Unusable(
                f"{who} has coordinates that are no numbers: {one[:60]}{_BLANKS}"
            ) from None
        up = more[0] if more else None
        height = up if mode == "relativeToGround" else None
        altitude = up if mode == "absolute" else None
        found.append(spot(latitude, longitude, who, height, altitude))
    return tuple(found)


def _child(element: Element, name: str) -> Element | None:
    return next((one for one in element if local(one.tag) == name), None)


def _text(element: Element, name: str) -> str | None:
    found = _child(element, name)
    return None if found is None or found.text is None else found.text.strip()
