"""What goes wrong in a simulation: drawn for each flight when it begins, from its name alone."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """The flight that a take-off begins. The same flight has the same id in every run."""

    id: str
    """`mission/trip/round/attempt`."""
    seconds: float
    """How long the flight is expected to take until its action is done."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Faults:
    """How likely each thing is to go wrong on a flight, from 0 to 1."""

    crash: float = 0.0
    link: float = 0.0
    action: float = 0.0
    battery: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawn:
    """What goes wrong on one flight, and when: seconds from take-off."""

    crash: float | None = None
    link: float | None = None
    battery: float | None = None
    action: bool = False


def draw(faults: Faults, seed: int, order: Order | None) -> Drawn:
    """Draw what goes wrong on a flight. The way home, which has no order, goes well."""
    if order is None:
        return Drawn()
    chance = Random(f"{seed}/{order.id}")

    def moment(probability: float) -> float | None:
        # Both numbers are drawn in any case: no probability changes what another one brings.
        happens, when = chance.random() < probability, chance.random() * order.seconds
        return when if happens else None

    return Drawn(
        crash=moment(faults.crash),
        link=moment(faults.link),
        battery=moment(faults.battery),
        action=chance.random() < faults.action,
    )
