"""An app whose drones are there at once: what is left is what the app itself costs."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from functools import partial

from pluto_fleet.app import described
from pluto_fleet.files.fleet import DroneEntry, FleetFile
from pluto_fleet.jobs.link import Link, Message, Order
from pluto_fleet.jobs.reports import DroneReport, FleetReport, fleet_report_data
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.domain import model
from pluto_fleet.shared.domain.actions import BUILT_IN
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.app import App
from pluto_fleet.shared.domain.fields import Entity, Field, FieldType
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.policies import first
from pluto_fleet.shared.flow.run import Run
from pluto_fleet.shared.time.kernel import FLEET, EventKind, Kernel
from plutoc_blocks.clock.step import wait_for_time
from plutoc_blocks.drone_allocator.step import allocate_drone
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.trip_launcher.step import launch_trip
from plutoc_blocks.trip_monitor.step import watch_trip

HOME: Point = (1.0, 1.0, 0.0)
SECONDS = 10.0
"""What a trip takes in virtual time."""


@dataclass(slots=True, kw_only=True, eq=False)
class Trip(model.Trip):
    """A trip of an app with a Clock."""

    delay: float | None = None
    priority: int = 0


@dataclass(slots=True, kw_only=True, eq=False)
class Mission(model.Mission[Trip]):
    """A mission of such trips."""

    at: float | None = None
    every: float | None = None


async def flow(run: Run[Mission]) -> Status:
    """Take a mission through create → wait → allocate → launch → watch, trip by trip."""
    mission, status = run.mission, create_mission(run, run.status)
    while True:
        delay, priority = mission.current.delay, mission.current.priority
        status = await wait_for_time(run, status, block="wait", delay=delay)
        status = await allocate_drone(
            run, status, block="allocate", policy=first, priority=priority
        )
        status = await watch_trip(run, launch_trip(run, status))
        if status is not Status.STANDBY:
            return status


APP = described(
    App(
        name="instant",
        title="Drones that are there at once",
        flow=flow,
        mission=Mission,
        trip=Trip,
        fields=(
            Field(name="delay", on=Entity.TRIP, type=FieldType.TIME, label="Delay"),
            Field(name="priority", on=Entity.TRIP, type=FieldType.INT, label="Priority", default=0),
        ),
        categories=(Category(name="quick"),),
        actions=BUILT_IN,
    )
)


def plan(missions: int, trips: int) -> list[Mission]:
    """Return so many missions, each of so many trips."""
    return [
        Mission(
            name=f"Mission {number}",
            index=number,
            trips=[
                Trip(
                    name=f"Trip {n}",
                    index=n,
                    action="measure",
                    target=(1.0 + n, 2.0, 1.2),
                    priority=n % 3,
                )
                for n in range(trips)
            ],
        )
        for number in range(missions)
    ]


def ground(drones: int) -> FleetFile:
    """Return a fleet that stands in one place."""
    entries = (DroneEntry(id=f"cf{n}", category="quick", home=HOME) for n in range(drones))
    return FleetFile(airspace=Airspace(), drones=tuple(entries))


@dataclass(frozen=True, slots=True)
class Docked:
    """What is known of a drone that never is anywhere else."""

    location: Point = HOME
    battery_level: float = 1.0
    landed: bool = True
    silence: float = 0.0


class Instant(Link):
    """A gateway whose drones are there, and back, as soon as they are told to go."""

    def __init__(self, kernel: Kernel, drones: int) -> None:
        super().__init__()
        self._kernel, self._docked = kernel, Docked()
        self._drones = {f"cf{n}": n for n in range(drones)}

    def telemetry(self, drone: str) -> Docked:
        """Return what is known of a drone."""
        return self._docked

    def moves(self, drone: str) -> bool:
        """It never does."""
        return False

    def send(self, order: Order) -> None:
        """Do what is ordered: a flight measures something, and all else is done at once."""
        if order["do"] == "fly":
            self._fly(order["drone"], {"done": order["id"], "value": 21.5})
        elif order["do"] == "call":
            report = FleetReport(drones=dict(map(_report, self._drones)), jobs={})
            self._tell({"done": order["id"], "value": fleet_report_data(report)})
        elif order["do"] == "recover":
            self._tell({"done": order["id"], "value": True})
        elif "id" in order:
            self._tell({"done": order["id"], "value": None})

    def _fly(self, drone: str, message: Message) -> None:
        """Report what was measured: in real time at once, and as something that comes by itself."""
        kernel = self._kernel
        if isinstance(kernel, RealTime):
            asyncio.get_running_loop().call_soon(kernel.post, self.take, message)
        else:
            when = (
                kernel.now + SECONDS + self._drones[drone] / 1000
            )  # each at an instant of its own
            kernel.at(when, EventKind.FLIGHT, FLEET, partial(self.take, message))

    def _tell(self, message: Message) -> None:
        now = self._kernel.now
        self._kernel.at(now, EventKind.FLIGHT, FLEET, partial(self.take, message))


def _report(drone: str) -> tuple[str, DroneReport]:
    """Return that nothing has happened."""
    report = DroneReport(
        drone=drone,
        reached=True,
        location=HOME,
        landed=True,
        battery_level=1.0,
        boot=1,
        carrying=None,
        done={},
    )
    return drone, report
