"""Names that are two for the app and one for whoever reads them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any
from unicodedata import normalize

from plutoc_runtime.domain.text import quoted

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission

    from .drones import DroneEntry


def look_alikes(
    missions: Sequence[Mission[Any]], drones: Sequence[DroneEntry] = ()
) -> Iterator[str]:
    """Yield a sentence for each two missions, trips of one mission, or drones that look the same."""
    for one, other in _alike(mission.name for mission in missions):
        yield _sentence("missions", one, other)
    for one, other in _alike(drone.id for drone in drones):
        yield _sentence("drones", one, other)
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
    "\u0430\u0435\u043a\u043e\u0440\u0441\u0443\u0445\u0456\u0458\u0455\u0475\u04bb\u04cf\u0501\u051b\u051d"
    "\u0410\u0412\u0415\u041a\u041c\u041d\u041e\u0420\u0421\u0422\u0423\u0425\u0406\u0408\u0405\u04c0"
    "\u0391\u0392\u0395\u0396\u0397\u0399\u039a\u039c\u039d\u039f\u03a1\u03a4\u03a5\u03a7"
    "\u03b1\u03b9\u03ba\u03bd\u03bf\u03c1\u03c5\u03c7\u03f3\u0131\u0251\u0261\u0570\u057d\u0581\u0585"
    "\u2010\u2012\u2013\u2014\u2015\u2212\u2018\u2019\u02bc\u201c\u201d\u2044\u2215"
    "\u1160\u115f\u2800",
    "aekopcyxijsvhldqw"
    "ABEKMHOPCTYXIJSI"
    "ABEZHIKMNOPTYX"
    "aikvopuxjiaghugo"
    "------'''\"\"//"
    "   ",
    "\u034f\u17b4\u17b5"
    + "".join(map(chr, (*range(0x180B, 0x1810), *range(0xFE00, 0xFE10), *range(0xE0100, 0xE01F0)))),
)
"""Letters of other alphabets that are drawn as Latin ones, and signs that are drawn alike, or not at all."""
