"""Who else looks at the station: what each browser says of itself, which is shown and never trusted."""

from __future__ import annotations

from ...shared.domain.text import cut_off, printable
from ..wire import Me, Person, Role
from .audit import LONGEST_WHO

_LONGEST = {"id": 32, "name": LONGEST_WHO, "page": 40, "touches": 64}
"""Characters of each text; what is longer is cut off."""


def shortened(me: Me) -> Me:
    """Return what a page says of itself, sanitized."""
    return {
        "id": _short(me["id"], "id"),
        "name": _short(me["name"], "name"),
        "page": _short(me["page"], "page"),
        "touches": _short(me["touches"], "touches"),
    }


def _short(text: str, what: str) -> str:
    return cut_off(printable(text.strip()), _LONGEST[what])


class People:
    """The browsers that are connected."""

    def __init__(self) -> None:
        self._here: dict[object, Person] = {}
        self.version = 0
        """It grows with every change."""

    def enter(self, page: object, role: Role, me: Me) -> None:
        """Note what a connected page says of itself."""
        person: Person = {**me, "role": role}
        if self._here.get(page) != person:
            self._here[page] = person
            self.version += 1

    def leave(self, page: object) -> None:
        """Forget a page, as its connection has ended."""
        if self._here.pop(page, None) is not None:
            self.version += 1

    def others(self, page: object) -> list[Person]:
        """Return all but the person at a page, each once, as their latest page says."""
        own = self._here.get(page)
        found = {person["id"]: person for person in self._here.values()}
        if own is not None:
            found.pop(own["id"], None)
        return list(found.values())
