"""Whether a vehicle does what it was told, or acts by itself, as a failsafe or a pilot does: seen by its modes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum, auto

_SETTLES = 2.0
"""Seconds in which it must take a mode of what it was told to do; one that it leaves again is noticed at once."""


class Change(Enum):
    """What a look at its mode has brought."""

    NONE = auto()
    LEAVES = auto()
    """It acts by itself from now on."""
    IS_BACK = auto()
    """It has been given back."""


@dataclass(slots=True)
class Obedience:
    """What one vehicle was told last, and whether it is at that."""

    order: str = ""
    """`rise`, `go`, `hold` or `land`; nothing: it has not been told yet."""
    by_itself: str = ""
    """What it does by itself; nothing: it does what it was told."""
    _agreed: float = 0.0
    _obeys: bool = False
    """When its mode was last one of what it was told, and whether it has been since."""
    _back: float | None = None
    """Since when it is again in a mode in which it takes orders."""

    def tell(self, order: str, now: float, *, obeys: bool = False) -> None:
        """Note what it is told; `obeys`: it is in a mode of that already."""
        self.order = order
        self._agreed = now
        self._obeys = obeys

    def stand(self, now: float) -> None:
        """Note that it is on the ground: what it did is over."""
        self.by_itself = ""
        self.tell("", now)

    def is_in(self, order: str, mode: int, modes: Mapping[str, frozenset[int]]) -> bool:
        """Return whether it is in a mode of an order already, by what it has told and by what it was told last."""
        return mode in modes[order] and self.order in ("", "rise", order)

    def look(self, mode: int, modes: Mapping[str, frozenset[int]], now: float) -> Change:
        """Take its mode; return whether it leaves what it was told, has come back to that, or is at it as before."""
        if self.by_itself:
            return self._comes_back(mode in modes["go"] | modes["hold"], now)
        # one that flew before it was connected to may have been told anything; if it lands, it is let land
        told = (self.order,) if self.order else ("rise", "go", "hold")
        if any(mode in modes[what] for what in told):
            self._agreed = now
            self._obeys = True
            return Change.NONE
        return Change.LEAVES if self._obeys or now - self._agreed > _SETTLES else Change.NONE

    def _comes_back(self, takes_orders: bool, now: float) -> Change:
        """Return whether it has been given back: it is, and stays, in a mode in which it may be told what to do."""
        if not takes_orders:
            self._back = None
            return Change.NONE
        if self._back is None:
            self._back = now
        if now - self._back <= _SETTLES:
            return Change.NONE
        self._back = None
        self.by_itself = ""
        self.tell("", now)
        return Change.IS_BACK
