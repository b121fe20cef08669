"""Takes the speed for a wish."""

from __future__ import annotations

from pluto_fleet.drones import DroneSetup
from pluto_fleet.simulation.body import SimulatedDrone
from plutoc_runtime.domain.model import Category
from tests.navigation.simulated import Simulated

FOUND_BY = "test_it_is_never_faster_than_it_was_told"
SAYS = "go_to at no more than 5.0 m/s flew at"


class Wrong(Simulated):
    """Half as fast again."""

    def __init__(self, setup: DroneSetup) -> None:
        super().__init__(setup)
        quick = Category(name="quick", speed=0.8)
        self.body.drone = SimulatedDrone(id=setup.id, category=quick, home=setup.home)
