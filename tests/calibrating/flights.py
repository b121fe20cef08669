"""Makes journals in virtual time, of drones that move as a test wants."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from math import inf
from pathlib import Path
from random import Random

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.files.writing import fleet_text
from pluto_fleet.flight.recorded_flight import RecordedFlight
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.gateway.ledger import Ledger
from pluto_fleet.jobs.controls import Controls, fleet_drones
from pluto_fleet.journal.header import header
from pluto_fleet.journal.standing import Standing
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.model import Category, Mission
from pluto_fleet.shared.domain.motion import Motion
from pluto_fleet.shared.events.world import MovingWorld
from pluto_fleet.shared.time.kernel import Kernel
from pluto_fleet.shared.time.told import VirtualTime
from pluto_fleet.simulation.drones import SimulatedNavigation
from tests.kit import apps

Around = Callable[[Kernel, Controls], Controls]


class _Disk:
    """A disk that takes no time; all is written at the end."""

    def __init__(self) -> None:
        self.entries: list[Entry] = []
        self.life: RecordedFlight | None = None

    def add(self, entry: Entry) -> int:
        """Take an entry, which is durable at once."""
        self.entries.append(entry)
        if self.life is not None:
            self.life.recorder.durable(len(self.entries))
        return len(self.entries)


def flown(
    path: Path,
    app: App,
    fleet: FleetFile,
    *missions: Mission[apps.Trip],
    motion: Motion | None = None,
    seed: int = 0,
    around: Around | None = None,
) -> Path:
    """Fly missions with a journal; `motion`: how the drones move, whatever the fleet file says."""
    for index, mission in enumerate(missions):
        mission.index = index
    planned, app = app, moving(app, motion or fleet.motion)
    kernel = VirtualTime()
    disk = _Disk()
    drones = fleet_drones(app, fleet)
    world = MovingWorld(seed, fleet.airspace, fleet.world)
    controls: Controls = SimulatedNavigation(kernel, drones, world, Faults(), seed)
    if around is not None:
        controls = around(kernel, controls)
    gateway = Gateway(
        kernel, controls, drones, fleet.airspace, ledger=Ledger(), apart=fleet.apart, measures=True
    )
    link = gateway.link(1)
    life = RecordedFlight(
        moving(planned, fleet.motion), fleet, kernel, link, disk, Standing(), epoch=1
    )
    disk.life = life
    kernel.run(life.start(missions))
    life.recorder.finish()
    told = header(app, missions="", fleet=fleet_text(fleet), sim=True, seed=seed)
    with closing(Store.create(path, told)) as store:
        store.append(disk.entries)
    return path


def surveyed(
    path: Path,
    motion: Motion,
    *,
    said: Motion,
    trips: int,
    drones: int = 3,
    speed: float = 0.5,
    within: float = 12.0,
    highest: float = 1.8,
    near: float = inf,
    seed: int = 0,
    around: Around | None = None,
) -> Path:
    """Fly trips to all over the map and all heights, with a fleet file that says another motion.

    `near`: every second one leads no farther than that, along x and y.
    """
    chance = Random(f"{seed}/survey")
    scout = Category(name="scout", speed=speed)
    app = apps.changed(apps.app(apps.flow(), categories=[scout]), resumes=("allocate",))
    fleet = apps.fleet(*[(1.0 + 2 * i, 0.5, 0.0) for i in range(drones)])
    size = max(20.0, within + 1.0)
    fleet = replace(fleet, motion=said, airspace=replace(fleet.airspace, size=(size, size)))
    missions = []
    for number in range(drones):
        mine = []
        x = y = within / 2
        for at in range(trips // drones):
            action = chance.choice(("measure", "take_photo"))
            far = near if at % 2 else inf
            x = chance.uniform(max(1.0, x - far), min(within, x + far))
            y = chance.uniform(max(1.0, y - far), min(within, y + far))
            target = (x, y, chance.uniform(0.5, highest))
            mine.append(apps.Trip(name=str(at), action=action, target=target))
        missions.append(apps.mission(f"m{number}", *mine))
    return flown(path, app, fleet, *missions, motion=motion, seed=seed, around=around)
