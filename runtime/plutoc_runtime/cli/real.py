"""Before real drones are flown: what can be known to be wrong without any radio."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..crazyflie.borrowed import require
from ..drones import refusals
from ..drones.loading import hears, load_localization, load_navigation
from ..errors import BadInput
from ..files.behaviour import CRAZYFLIE, OWN
from ..files.reading import shortened
from ..files.real import navigation_of, not_real

if TYPE_CHECKING:
    from ..files.fleet import FleetFile


def check_real(fleet: FleetFile, where: str, *, stand_ins: bool) -> None:
    """Raise `BadInput` if this fleet cannot be flown from here; nothing has started.

    `where` its file is, for whoever must mend it.
    """
    problems = [] if stand_ins else not_real(fleet)
    if problems:
        raise BadInput(shortened([f"{where}: {sentence}" for sentence in problems]))
    names = dict.fromkeys(navigation_of(fleet, drone) for drone in fleet.drones)
    if CRAZYFLIE in names:
        require()
    for name in names:
        load_navigation(name)
    if fleet.localization != OWN:
        load_localization(fleet.localization)
        deaf = [one.id for one in fleet.drones if not hears(navigation_of(fleet, one))]
        if deaf:
            raise refusals.deaf(fleet.localization, deaf)
