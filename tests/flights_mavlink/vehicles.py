"""Flights of four vehicles, two of each make, in which things go wrong; and what must hold of any."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from pluto_fleet.autopilot import process
from pluto_fleet.autopilot.process import SimulatedFleet
from pluto_fleet.files.stand_ins import SOMEWHERE
from tests.flights_mavlink.flight import VehicleFlight
from tests.kill.trial import gateway_of
from tests.kit.apps import compiled_file

APP = "surveys"
HERE = Path(__file__).parent
MAKES = {"m1": "px4", "m2": "ardupilot", "m3": "px4", "m4": "ardupilot"}
"""The vehicles; three missions are flown, so that one of them has time."""
STRANGER = "m5"
"""One that the fleet file does not have."""
HOMES = {id: (10.0 * number - 5.0, 5.0, 0.0) for number, id in enumerate((*MAKES, STRANGER), 1)}
USUAL = {
    "px4": {"RTL_RETURN_ALT": 6.0, "MPC_TKO_SPEED": 3.0, "MPC_LAND_SPEED": 1.5},
    "ardupilot": {"RTL_ALT": 600.0, "LAND_SPEED": 120.0},
}
"""Lower and faster than they come, for these flights take the time that they take."""
MISSIONS = ("m1", "m2", "m3")
DISTANCES = {"near": 20.0, "far": 30.0}
"""How far to the north each mission takes a photo, by the names of its trips."""
LIMIT = 400.0
"""Seconds that a flight may take."""

Value = float | bool | str
Parameters = Mapping[str, Mapping[str, float]]


@dataclass(kw_only=True)
class Vehicles(VehicleFlight):
    """A flight in which things go wrong."""

    def let(self, drone: str, fault: str, value: Value | list[float] = True) -> None:
        process.told(self.air, "fault", drone=drone, name=fault, value=value)

    @property
    def has_ended(self) -> bool:
        """Whether the app has."""
        return self.life is None or self.life.poll() is not None

    @property
    def has_failed(self) -> bool:
        """Whether a trip has."""
        return any(event["event"] == "trip.failed" for event in self.events)

    def set_up(self, parameters: Parameters) -> None:
        """Set parameters, by make, of all vehicles."""
        for id, make in MAKES.items():
            for name, value in {**USUAL[make], **parameters.get(make, {})}.items():
                self.let(id, f"parameter {name}", value)

    def join(self, id: str, make: str) -> None:
        """Have one more vehicle switched on."""
        process.start(self.air, _fleet({**MAKES, id: make}))

    def restart_gateway(self) -> None:
        """Kill the gateway; the app must start it again."""
        old = gateway_of(self.journal)
        self.kill_gateway()
        self.until(lambda: gateway_of(self.journal) not in (None, old), 30.0)


def package(into: Path) -> Path:
    """Compile the app that is flown; return the folder of its sources."""
    return compiled_file(HERE / "app.pluto", into) / "src"


def prepared(source: Path, folder: Path, parameters: Parameters) -> Vehicles:
    """Return a flight that has not begun, with its vehicles switched on."""
    world = folder / "vehicles"
    uris = process.start(world, _fleet(MAKES))
    _write(folder, uris)
    flight = Vehicles(app=APP, source=source, folder=folder, world=world)
    flight.set_up(parameters)
    return flight


def _fleet(makes: Mapping[str, str]) -> SimulatedFleet:
    return SimulatedFleet(
        plane=SOMEWHERE,
        homes={id: HOMES[id] for id in makes},
        makes=makes,
        flights=dict.fromkeys(makes, 600.0),
        charges=dict.fromkeys(makes, 60.0),
    )


def _write(folder: Path, uris: Mapping[str, str]) -> None:
    """Write the files of a flight: two photos in each of three missions, before the first three vehicles."""
    drones = "".join(
        f'[[drone]]\nid = "{id}"\nhome = {list(HOMES[id][:2])}\nuri = "{uri}"\n'
        for id, uri in uris.items()
    )
    place = (
        f"{{ latitude = {SOMEWHERE.latitude}, longitude = {SOMEWHERE.longitude},"
        f" altitude = {SOMEWHERE.altitude} }}"
    )
    (folder / "fleet.toml").write_text(
        f"[map]\nsize = [60, 60]\ncruise_height = 5.0\nceiling = 15.0\norigin = {place}\n"
        f'[fleet]\napart = 3.0\nnavigation = "mavlink"\n[motion]\nlegs = "steady"\n{drones}'
    )
    (folder / "missions.toml").write_text(
        "".join(
            f'[[mission]]\nname = "{id}"\n'
            + "".join(
                f'[[mission.trip]]\nname = "{name}"\naction = "take_photo"\ntarget = [{HOMES[id][0]}, {y}]\n'
                for name, y in DISTANCES.items()
            )
            for id in MISSIONS
        )
    )


def never(flight: Vehicles, falls: Sequence[str] = ()) -> Iterator[str]:
    """Yield what no flight may come to, by the vehicles' own record; `falls`: those that may fall."""
    yield from (f"{id} is in the air" for id in flight.airborne())
    taken = 0
    for id, one in flight.state.items():
        taken += len(one["photos"])
        if one["fell"] and id not in falls:
            yield f"{id} fell"
        for what in one["overruled"]:
            yield f"{id} was ordered {what}"
    done = sum(event["event"] == "trip.completed" for event in flight.events)
    failed = sum(event["event"] == "trip.failed" for event in flight.events)
    if not done <= taken <= done + failed:
        yield f"{taken} photos were taken for {done} trips"
