"""Faults in a simulation, drawn for each flight at its start from its id alone."""

from __future__ import annotations

from dataclasses import dataclass, fields
from random import Random
from typing import TYPE_CHECKING

from ..domain.errors import Failure, FlightFailed
from ..domain.quantities import Type, parse_quantity
from ..domain.text import place, quoted

if TYPE_CHECKING:
    from ..domain.model import Point

OUTAGE = 20.0  # seconds until a lost link is restored
CARRYING_HOME = 300.0  # seconds until someone has carried a drone home

_BEFALL = {  # what happens at one moment of a flight: the first fields of `Drawn`, in their order
    Failure.CRASH: "crashed",
    Failure.LINK: "lost its link",
    Failure.BATTERY: "ran out of battery",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Faults:
    """The probability of each fault on a flight, from 0 to 1."""

    crash: float = 0.0
    link: float = 0.0
    action: float = 0.0
    battery: float = 0.0


_NONE = Faults()
FAULTS = tuple(fault.name for fault in fields(Faults))  # the faults of `--fail`


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawn:
    """The faults of one flight, in seconds from take-off."""

    crash: float | None = None
    link: float | None = None
    battery: float | None = None
    action: bool = False

    def moments(self, began: float) -> list[tuple[float, Failure | None]]:
        """Return the faults with their times, for a flight that took off at this time."""
        drawn = zip((self.crash, self.link, self.battery), _BEFALL, strict=True)
        return [(began + after, what) for after, what in drawn if after is not None]


def draw(faults: Faults, seed: int, flight: str, seconds: float) -> Drawn:
    """Draw the faults of a flight by its id, `mission/trip/round/attempt`: the same in every run.

    They happen within the expected seconds until its action is done.
    """
    if faults == _NONE:
        return Drawn()
    chance, moments = Random(f"{seed}/{flight}"), dict[str, float]()
    for name in (what.value for what in _BEFALL):
        # Both numbers are drawn in any case, so one probability does not change the other's outcome.
        happens, when = chance.random() < getattr(faults, name), chance.random() * seconds
        if happens:
            moments[name] = when
    return Drawn(**moments, action=chance.random() < faults.action)


def befell(drone: str, what: Failure, at: Point) -> FlightFailed:
    """Return the failure of every command after a fault."""
    return FlightFailed(what, f"{drone} {_BEFALL[what]} at {place(at)}")


def failed(what: str, why: str, at: Point) -> FlightFailed:
    """Return the failure of an action, with its place."""
    return FlightFailed(Failure.ACTION, f"{what}: {why} at {place(at)}")


def shares(text: str) -> dict[str, float]:
    """Read crash=10%,link=5%."""
    found: dict[str, float] = {}
    for part in text.split(","):
        what, equals, amount = (piece.strip() for piece in part.partition("="))
        if not equals:
            raise ValueError(f"{quoted(part)} is not written like crash=10%")
        if what not in FAULTS:
            raise ValueError(f"{quoted(what)} cannot go wrong; what can: {', '.join(FAULTS)}")
        if what in found:
            raise ValueError(f"{what} is given twice")
        try:
            found[what] = parse_quantity(amount, Type.PERCENT)
        except ValueError:
            wrong = f"{what}={amount} is not a percentage: write it like {what}=10%"
            raise ValueError(wrong) from None
        if not 0 <= found[what] <= 1:
            raise ValueError(f"{what}={amount} is not between 0% and 100%")
    return found
