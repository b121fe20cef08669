"""What does it cost to fly many MAVLink vehicles, and how old is what their app knows of them?

`python benchmarks/many_vehicles.py` flies 50 simulated vehicles for ten minutes in real time, by `fly --mavlink-sim 50`, through MAVSDK: each
mission photographs four places on a field of 300 × 200 m, again and again. It prints what each process takes of a core, the simulated vehicles' apart from
ours, and what memory it holds at the begin and at the end; how many trips were flown; and how old the place is that the app knows of a
vehicle on its way: a hook notes it twice a second, and it is held against where the vehicle really was, asked once a second, while it flew straight on. Ends with 1 if a trip
has failed, a vehicle was lost, or a process was started again. Linux only: it reads /proc.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
import tomllib
from bisect import bisect
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import dist
from pathlib import Path
from statistics import median, quantiles

sys.path[:0] = [str(Path(__file__).parents[1])]

import tests  # noqa: F401  # first: all that follows shares one brain
from measuring.options import at_least_one
from tests.flights_mavlink.flight import VehicleFlight
from tests.kill.trial import gateway_of
from tests.kit.apps import compiled_file
from watching.server import memory_of, seconds_of

SOURCE = """\
pluto 1
app many "Many vehicles on a field" {
  category scout(speed: 5 m/s, flight_time: 40 min, charge_time: 10 min) can take_photo
  action note along
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  again = MissionRepeater
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> again when COMPLETED
  again -> allocate when STANDBY
  again -> end otherwise
  watch -> end when FAILED
}
"""
HOOKS = '''\
"""Where the app knows its vehicles to be."""

import os
import time
from pathlib import Path

from . import Context, Drone, Trip

NOTES = Path(os.environ["FLIGHT"]) / "notes.csv"


async def note(drone: Drone, trip: Trip, context: Context) -> None:
    """Write it down twice a second, with the time on the wall."""
    while True:
        x, y, _ = drone.location
        with NOTES.open("a") as notes:
            notes.write(f"{time.time()},{drone.id},{x},{y}\\n")
        await context.sleep(0.5)
'''
SIZE = (300.0, 200.0)
TRIPS = 4
_IN_A_ROW = 25
_ALL_UP = 300.0
_DOWN = 300.0
"""Seconds within which all must have set out, and must be down after a stop."""
_STEADY = 4.0
"""Metres a second from which on a vehicle counts as on its way."""
_STRAIGHT = 0.2
"""Metres a second by which its velocity may change from one second to the next while it flies straight on."""

Sample = tuple[float, float, float]
"""A time on the wall, and a place."""


def fleet(vehicles: int) -> str:
    """Return the fleet file: homes in rows along one side, 10 m from each other."""
    tables = [
        f"[map]\nsize = {[*SIZE]}\ncruise_height = 20.0\nceiling = 60.0\n",
        '[fleet]\napart = 3.0\nafter_trip = "next"\n[motion]\nlegs = "steady"\n',
    ]
    for number in range(vehicles):
        row, place = divmod(number, _IN_A_ROW)
        home = f"[{25 + 10 * place}.0, {10 + 10 * row}.0]"
        tables.append(f'[[drone]]\nid = "m{number + 1}"\nhome = {home}\n')
    return "\n".join(tables)


def missions(number: int) -> str:
    """Return the missions file: one for each vehicle, for ever; places are spread evenly."""
    tables: list[str] = []
    for mission in range(number):
        tables.append(f'[[mission]]\nname = "Mission {mission + 1}"\nrepeat = true\n')
        for trip in range(TRIPS):
            x = 10 + (mission * 37 + trip * 113) % int(SIZE[0] - 20)
            y = 60 + (mission * 53 + trip * 67) % int(SIZE[1] - 70)
            where = f"target = [{x}.0, {y}.0]"
            tables.append(f'[[mission.trip]]\naction = "take_photo"\nalong = "note"\n{where}\n')
    return "\n".join(tables)


def begun(folder: Path, vehicles: int) -> VehicleFlight:
    """Compile the app, and begin its flight."""
    (folder / "app.pluto").write_text(SOURCE)
    (folder / "hooks.py").write_text(HOOKS)
    (folder / "fleet.toml").write_text(fleet(vehicles))
    (folder / "missions.toml").write_text(missions(vehicles))
    source = compiled_file(folder / "app.pluto", folder / "package") / "src"
    flight = VehicleFlight(app="many", source=source, folder=folder, drones=vehicles)
    flight.start()
    return flight


def processes(flight: VehicleFlight) -> dict[str, int]:
    """Return the processes of a flight, by what they are."""
    gateway = gateway_of(flight.journal)
    if gateway is None:
        raise SystemExit(f"there is no gateway:\n{flight.told}")
    found = {"app": flight.pid, "gateway": gateway}
    for entry in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            words = (entry / "cmdline").read_bytes().split(b"\0")
            pid = int(entry.name)
            if b"mavsdk" in words and _parent_of(pid) == gateway:
                found["MAVSDK"] = pid
            elif b"autopilot" in words and str(flight.air).encode() in words:
                found["simulated vehicles"] = pid
    return found


def _parent_of(process: int) -> int:
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


def really(flight: VehicleFlight, seconds: float) -> Mapping[str, Sequence[Sample]]:
    """Let it fly for so long, and return where the vehicles were, once a second."""
    seen: dict[str, list[Sample]] = defaultdict(list)
    homes = _homes(flight)
    ends = time.monotonic() + seconds
    while time.monotonic() < ends and flight.wait(0.0) is None:
        before = time.time()
        state = flight.state
        asked = (before + time.time()) / 2
        for id, one in state.items():
            east, north, _ = one["at"]
            seen[id].append((asked, homes[id][0] + east, homes[id][1] + north))
        time.sleep(max(0.0, before + 1.0 - time.time()))
    return seen


def _homes(flight: VehicleFlight) -> dict[str, tuple[float, float]]:
    tables = tomllib.loads((flight.folder / "fleet.toml").read_text())["drone"]
    return {one["id"]: tuple(one["home"]) for one in tables}


def ages(flight: VehicleFlight, seen: Mapping[str, Sequence[Sample]]) -> Iterator[float]:
    """Yield how many seconds old each place is that was noted of a vehicle which flew straight on then."""
    for line in (flight.folder / "notes.csv").read_text().splitlines():
        when, id, x, y = line.split(",")
        age = _age((float(when), float(x), float(y)), seen[id])
        if age is not None:
            yield age


def _age(noted: Sample, seen: Sequence[Sample]) -> float | None:
    """Return how long ago a vehicle was where it was noted; None: its velocity changed about then."""
    after = bisect(seen, noted)
    if not 1 < after < len(seen) - 1:
        return None
    velocities = [_velocity(seen[n - 1], seen[n]) for n in (after - 1, after, after + 1)]
    vx, vy = velocities[1]
    speed = dist((vx, vy), (0.0, 0.0))
    if speed < _STEADY or any(dist(one, (vx, vy)) > _STRAIGHT for one in velocities):
        return None
    when, x, y = noted
    since, from_x, from_y = seen[after - 1]
    is_x = from_x + (when - since) * vx
    is_y = from_y + (when - since) * vy
    return ((is_x - x) * vx + (is_y - y) * vy) / speed**2


def _velocity(one: Sample, other: Sample) -> tuple[float, float]:
    passed = other[0] - one[0]
    return (other[1] - one[1]) / passed, (other[2] - one[2]) / passed


@dataclass(frozen=True, slots=True)
class Cost:
    """What the processes have used until now: seconds of CPU, and the megabytes that they hold."""

    at: float
    pids: Mapping[str, int]
    seconds: Mapping[str, float]
    memory: Mapping[str, float]


def cost(flight: VehicleFlight) -> Cost:
    pids = processes(flight)
    return Cost(
        time.monotonic(),
        pids,
        {name: seconds_of(pid) for name, pid in pids.items()},
        {name: memory_of(pid) for name, pid in pids.items()},
    )


def told(before: Cost, after: Cost) -> Iterator[str]:
    """Yield the rows of the processes."""
    passed = after.at - before.at
    yield "| process | of a core | MB at the begin | at the end |"
    yield "| --- | ---: | ---: | ---: |"
    for name, used in after.seconds.items():
        share = (used - before.seconds[name]) / passed
        held = f"{before.memory[name]:.0f} | {after.memory[name]:.0f}"
        yield f"| {name} | {share:.0%} | {held} |"


def wrong(flight: VehicleFlight, before: Cost, after: Cost) -> Iterator[str]:
    """Yield what must not be."""
    for event in flight.events:
        if event["event"] in ("trip.failed", "drone.lost", "drone.offline"):
            yield f"{event['event']}: {event.get('reason', event)}"
    for name, pid in before.pids.items():
        if after.pids.get(name) != pid:
            yield f"{name} was started again"
    if "Traceback" in flight.told:
        yield "a traceback was printed"


def main(words: Sequence[str] | None = None) -> int:
    """Fly, measure, and print."""
    parser = argparse.ArgumentParser(description="What it costs to fly many MAVLink vehicles.")
    parser.add_argument("--vehicles", type=at_least_one, default=50)
    parser.add_argument("--minutes", type=float, default=10.0)
    given = parser.parse_args(words)
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as name:
        flight = begun(Path(name), given.vehicles)
        try:
            flight.until(flight.journal.exists)
            flight.until(lambda: _launched(flight) >= given.vehicles, _ALL_UP)
            before = cost(flight)
            seen = really(flight, 60 * given.minutes)
            after = cost(flight)
            findings = list(wrong(flight, before, after))
            flown = sum(event["event"] == "trip.completed" for event in flight.events)
            flight.tell("stop", "--rtl")
            flight.see_through(_DOWN)
            all_ages = sorted(ages(flight, seen))
        finally:
            flight.end()
    print(
        f"{given.vehicles} vehicles, {given.minutes:g} min; load of the machine before: {load:.1f}"
    )
    print("\n".join(told(before, after)))
    print(f"{flown} trips were flown")
    print(
        f"age of a place that the app knows: median {1000 * median(all_ages):.0f} ms,"
        f" p95 {1000 * quantiles(all_ages, n=20)[18]:.0f} ms, of {len(all_ages)}"
    )
    print("\n".join(findings) or "no trip failed, and no vehicle was lost")
    return 1 if findings else 0


def _launched(flight: VehicleFlight) -> int:
    return sum(event["event"] == "trip.launched" for event in flight.events)


if __name__ == "__main__":
    sys.exit(main())
