"""Makes the team that a fleet file describes: a navigation for each drone, by the name it has there."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

from . import refusals
from .feeding import Feeding
from .loading import make_localization, make_navigation
from .localization import OWN
from .protocol import Locatable
from .setup import DroneSetup
from .team import Team, TeamDrone

if TYPE_CHECKING:
    from pathlib import Path

    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.model import Category, Point
    from plutoc_runtime.time.kernel import Kernel

    from .protocol import DroneNavigation
    from .real_fleet import RealDrone, RealFleet

FILES = "files"
"""The folder, in the gateway's, where navigations keep photos and the like."""


class Craft(Protocol):
    """What must be known of a drone."""

    @property
    def id(self) -> str:
        """Its name in the fleet."""
        ...

    @property
    def category(self) -> Category:
        """How fast it flies, and for how long."""
        ...

    @property
    def home(self) -> Point:
        """Where its dock is."""
        ...


def make_one(how: RealDrone, home: Point, speed: float, folder: Path) -> DroneNavigation:
    """Return what flies one drone, at this speed at most; nothing is reached yet.

    `BadInput`: its options are wrong.
    """
    setup = DroneSetup(
        id=how.id, uri=how.uri, home=home, speed=speed, options=how.options, folder=folder
    )
    return make_navigation(how.navigation, setup)


def top_speed(category: Category) -> float:
    """Return how fast drones of a category may fly at most."""
    return category.top_speed or category.speed


def make_team(
    kernel: Kernel,
    drones: Sequence[Craft],
    real: RealFleet,
    airspace: Airspace,
    folder: Path,
    say: Callable[[str], object],
) -> Team:
    """Return the team of a fleet; raise `BadInput` where it cannot be flown as its file says."""
    files = folder / FILES
    files.mkdir(mode=0o700, parents=True, exist_ok=True)
    how = {drone.id: drone for drone in real.drones}
    navigations: dict[str, DroneNavigation] = {}
    for drone in drones:
        speed = top_speed(drone.category)
        navigations[drone.id] = make_one(how[drone.id], drone.home, speed, files)
    return Team(
        kernel,
        [
            TeamDrone(
                id=drone.id,
                category=drone.category,
                home=drone.home,
                navigation=navigations[drone.id],
            )
            for drone in drones
        ],
        airspace,
        folder=folder,
        say=say,
        wanted=real.wanted,
        feeding=_feeding(real, navigations, say),
    )


def _feeding(
    real: RealFleet, navigations: Mapping[str, DroneNavigation], say: Callable[[str], object]
) -> Feeding | None:
    """Return what tells the drones where they are; None: they know it by themselves."""
    if real.localization == OWN:
        return None
    fed: dict[str, Locatable] = {}
    deaf: list[str] = []
    for id, navigation in navigations.items():
        if isinstance(navigation, Locatable):
            fed[id] = navigation
        else:
            deaf.append(id)
    if deaf:
        raise refusals.deaf(real.localization, deaf)
    source = make_localization(real.localization, real.localization_options)
    return Feeding(real.localization, source, fed, say)
