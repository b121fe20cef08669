"""Names that are two for the app and one for whoever reads them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any
from unicodedata import normalize

from .words import quoted

if TYPE_CHECKING:
    from .model import Mission


def look_alikes(missions: Sequence[Mission[Any]]) -> Iterator[str]:
    """Yield a sentence for each two missions, or trips of one mission, whose names look the same."""
    for one, other in _alike(mission.name for mission in missions):
        yield _sentence("missions", one, other)
    for mission in missions:
        for one, other in _alike(trip.name for trip in mission.trips):
            yield _sentence(f"trips of mission {quoted(mission.name)}", one, other)


def _alike(names: Iterable[str]) -> Iterator[tuple[str, str]]:
    first: dict[str, str] = {}
    for name in names:
        known = first.setdefault(_seen(name), name)
        if known != name:
            yield known, name


def _seen(name: str) -> str:
    """Return a name as an eye takes it: whatever letters it is made of, large or small."""
    plain = normalize("NFKC", name).translate(_LETTERS).casefold()
    return " ".join(normalize("NFKC", plain).split())


def _sentence(what: str, one: str, other: str) -> str:
    return (
        f"two {what} are easily taken for one another, {quoted(one)} and {quoted(other)}"
        f" ({one!a} and {other!a}): rename one"
    )


_LETTERS = str.maketrans(
    "\u0430\u0435\u043e\u0440\u0441\u0443\u0445\u0456\u0458\u0455"
    "\u0410\u0412\u0415\u041a\u041c\u041d\u041e\u0420\u0421\u0422\u0425\u0406\u0408\u0405"
    "\u0391\u0392\u0395\u0396\u0397\u0399\u039a\u039c\u039d\u039f\u03a1\u03a4\u03a5\u03a7\u03bf",
    "aeopcyxijsABEKMHOPCTXIJSABEZHIKMNOPTYXo",
)
"""Letters of the Cyrillic and the Greek alphabet that are drawn as Latin ones."""
