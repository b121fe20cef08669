"""Checks of real drones before any is connected."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from ..crazyflie.driver import require
from ..drones.loading import (
    canonical_uri,
    deaf,
    hears,
    load_localization,
    load_navigation,
    make_tracker,
)
from ..drones.real_fleet import real_fleet
from ..drones.team import make_one
from ..files.addresses import which
from ..files.fleet import (
    CRAZYFLIE,
    MAVLINK,
    OWN,
    navigation_of,
    not_real,
    shared_by_air,
)
from ..mavlink.needs import require as require_mavsdk
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.values import shortened

if TYPE_CHECKING:
    from ..app import App
    from ..drones.protocol import DroneNavigation
    from ..files.fleet import DroneEntry, FleetFile
    from .options import Options


OR_SIMULATED = "; or fly simulated drones: add --sim"


def check_real(
    app: App, fleet: FleetFile, where: str, *, stand_ins: bool, instead: str = ""
) -> None:
    """Raise `BadInput` if this fleet cannot be flown from here; nothing is started.

    `where` names its file, in messages; `instead` says what could be flown. Navigations are created,
    but not connected.
    """
    if not stand_ins and (problem := not_real(fleet)):
        raise BadInput(f"{where}: {problem}{instead}")
    names = dict.fromkeys(navigation_of(fleet, drone) for drone in fleet.drones)
    if CRAZYFLIE in names:
        require()
    if MAVLINK in names:
        require_mavsdk(simulated=stand_ins)
    for name in names:
        load_navigation(name)
    if fleet.localization != OWN:
        load_localization(fleet.localization)
        told_in_vain = [one.id for one in fleet.drones if not hears(navigation_of(fleet, one))]
        if told_in_vain:
            raise deaf(fleet.localization, told_in_vain)
    if fleet.tracker is not None:
        make_tracker(fleet.tracker, fleet.tracker_options)
    _check_options(app, fleet, where)


def check_flight(app: App, fleet: FleetFile, options: Options) -> None:
    """Raise `BadInput` if what `fly` or `serve` is to fly are real drones that cannot be flown."""
    if not options.is_real:
        return
    where = str(options.fleet or app.name)
    stand_ins = options.stand_ins is not None
    check_real(app, fleet, where, stand_ins=stand_ins, instead=OR_SIMULATED)
    if not stand_ins and not options.supervised:
        warn_of_the_radio(fleet, where)


def warn_of_the_radio(fleet: FleetFile, where: str) -> None:
    """Say in which ways the fleet's drones are in each other's way on the air."""
    for sentence in shared_by_air(fleet):
        output.tell(f"{where}: warning: {sentence}")


def _check_options(app: App, fleet: FleetFile, where: str) -> None:
    problems: list[str] = []
    reached: dict[str, str] = {}
    with TemporaryDirectory() as folder:
        for drone in fleet.drones:
            try:
                made(app, fleet, drone, Path(folder))
                _check_alone(fleet, drone, reached)
            except BadInput as error:
                problems.append(f"{where}:{drone.line}: {error}" if drone.line else str(error))
    if problems:
        raise BadInput(shortened(problems))


def _check_alone(fleet: FleetFile, drone: DroneEntry, reached: dict[str, str]) -> None:
    """Raise `BadInput` if a drone is reached as another one: to its navigation they are the same."""
    uri = canonical_uri(navigation_of(fleet, drone), drone.id, drone.uri)
    if uri is None:
        return
    other = reached.setdefault(which(uri), drone.id)
    if other != drone.id:
        raise BadInput(f"{drone.id}: uri is that of {other}: it would be one and the same drone")


def made(app: App, fleet: FleetFile, drone: DroneEntry, folder: Path) -> DroneNavigation:
    """Create a drone's navigation, not connected; raise `BadInput` if its options are wrong."""
    (category,) = (one for one in app.categories if one.name == drone.category)
    real = real_fleet(fleet, ())
    (how,) = (one for one in real.drones if one.id == drone.id)
    return make_one(how, drone.home, category.speed, folder, real)
