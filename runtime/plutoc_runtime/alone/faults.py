"""Faults in a simulation, drawn for each flight at its start from its id alone."""

from __future__ import annotations

from dataclasses import dataclass, fields
from math import inf
from random import Random

from ..domain.errors import Failure
from ..domain.quantities import Type, parse_quantity
from ..domain.text import quoted

OUTAGE = 20.0  # seconds until a lost link is restored
CARRYING_HOME = 300.0  # seconds until someone has carried a drone home

BEFALL = {  # what happens at one moment of a flight
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


FAULTS = tuple(fault.name for fault in fields(Faults))  # the faults of `--fail`


def draw(faults: Faults, seed: int, flight: str, seconds: float) -> dict[Failure, float]:
    """Draw the faults of `mission/trip/round/attempt`, so many seconds after its take-off at most."""
    drawn = dict[Failure, float]()
    if faults == Faults():
        return drawn
    chance = Random(f"{seed}/{flight}")
    for what in BEFALL:
        # Both numbers are drawn in any case, so one probability does not change the other's outcome.
        happens = chance.random() < getattr(faults, what.value)
        when = chance.random() * seconds
        if happens:
            drawn[what] = when
    if chance.random() < faults.action:
        drawn[Failure.ACTION] = inf  # at no moment by itself
    return drawn


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
