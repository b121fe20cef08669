"""What does it cost to choose drones, and how does that grow with the fleet and with the queue?

`python benchmarks/choosing.py` prints three tables. *A choice*: microseconds in
which one of the free drones is chosen, by policy and by how many they are.
*All at once*: milliseconds in which `batch_optimal` shares drones out. *The queue*: whole plans, of
which most missions wait; seconds of CPU, and how much more a mission costs than in the first plan.
Drones that must charge between flights are measured apart: there, a mission that waits can be served soon.

The parts of a row run in turns, round after round; the least time of each counts. With `--json` the
numbers come as JSON.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import sqrt
from pathlib import Path
from random import Random
from resource import RUSAGE_CHILDREN, getrusage
from typing import TYPE_CHECKING, Any

from measuring.options import at_least_one
from plutoc_runtime.domain.model import Category, Drone, Point, Trip
from plutoc_runtime.fleet.batch_optimal import batch_optimal
from plutoc_runtime.fleet.policies import first, least_used, nearest

if TYPE_CHECKING:
    from plutoc_runtime.fleet.policies import OneByOne

FLEETS = (10, 100, 1_000, 10_000)
SHARES = ((10, 10), (30, 30), (100, 100), (300, 300), (1_000, 1_000), (1_000, 1_100), (1_000, 1))
"""How many trips wait, and how many drones are free."""
PLANS = (100, 400, 1_000)
TRIPS, DRONES = 6, 50
QUEUES = (
    *((policy, policy, "100 h") for policy in ("first", "least_used", "nearest", "batch_optimal")),
    ("least_makespan", "least_makespan", "100 h"),
    ("nearest, charging", "nearest", "420 s"),
)
"""What it is called, the policy, and how long a battery lasts."""
CHOICES = 200

SOURCE = """\
pluto 1
app {name} "Missions that wait for a drone" {{
  category quick(speed: 5 m/s, flight_time: {flight_time}) can take_photo
  create = MissionCreator
  allocate = DroneAllocator(policy: {policy})
  launch = TripLauncher
  watch = TripMonitor
  start -> create -> allocate -> launch -> watch
  retry = PriorityManager(max_attempts: 3)
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  retry -> end otherwise
  watch -> end otherwise
}}
"""

SCOUT = Category(name="scout")
Numbers = dict[str, float]


@dataclass(frozen=True, slots=True)
class Standing:
    """The telemetry of a drone in its dock."""

    location: Point
    battery_level: float = 1.0
    landed: bool = True
    silence: float = 0.0


@dataclass(frozen=True, slots=True)
class Waits:
    """What `batch_optimal` asks of a trip that waits."""

    goal: Point

    def able(self, drone: Drone) -> bool:
        """Accept every drone."""
        return True


POLICIES: Mapping[str, OneByOne] = {"nearest": nearest, "first": first, "least_used": least_used}


def field(count: int, seed: int = 0, height: float = 0.0) -> Iterator[Point]:
    """Give places in a field of 10 m² each."""
    random, side = Random(seed), sqrt(10.0 * count)
    return ((random.uniform(0, side), random.uniform(0, side), height) for _ in range(count))


def fleet(count: int) -> list[Drone]:
    """Return drones that stand about."""
    return [
        Drone(id=str(n), category=SCOUT, home=place, telemetry=Standing(place), index=n)
        for n, place in enumerate(field(count))
    ]


def trips(count: int, over: int) -> list[Trip]:
    """Return trips to places in the field of so many drones."""
    goals = list(field(over, seed=1, height=1.5))
    return [Trip(name="A", action="take_photo", target=goals[n % over]) for n in range(count)]


def anyone(drone: Drone) -> bool:
    """Accept every drone."""
    return True


def least(rounds: int, *works: Callable[[], object]) -> list[float]:
    """Run them in turns, and return the least seconds of CPU of each."""
    took = [[0.0] * rounds for _ in works]
    for number in range(rounds):
        for times, work in zip(took, works, strict=True):
            begun = time.process_time()
            work()
            times[number] = time.process_time() - begun
    return [min(times) for times in took]


def choices(rounds: int, fleets: Sequence[int]) -> Iterator[tuple[str, int, float]]:
    """Give policy, drones, and microseconds a choice."""

    def given(policy: OneByOne, drones: Sequence[Drone], asked: Sequence[Trip]) -> None:
        for trip in asked:
            policy(trip, drones, anyone)

    for name, policy in POLICIES.items():
        for count in fleets:
            asked = trips(max(10, min(CHOICES, 100_000 // count)), count)
            (seconds,) = least(rounds, partial(given, policy, fleet(count), asked))
            yield name, count, seconds / len(asked) * 1e6


def shares(rounds: int, sizes: Sequence[tuple[int, int]]) -> Iterator[tuple[int, int, float]]:
    """Give trips, drones, and the milliseconds in which drones are shared out."""
    for waiting, free in sizes:
        drones = fleet(free)
        offers: Any = [Waits(goal=one.target) for one in trips(waiting, max(waiting, free))]
        nothing: Any = None  # it asks no queue
        (seconds,) = least(
            rounds if waiting * free < 1e6 else 1, partial(batch_optimal, offers, drones, nothing)
        )
        yield waiting, free, seconds * 1e3


def queues(rounds: int, plans: Sequence[int]) -> Iterator[tuple[str, int, float]]:
    """Give policy, missions, and the seconds in which a plan is simulated."""
    with tempfile.TemporaryDirectory() as folder:
        for name, policy, flight_time in QUEUES:
            app = compiled(Path(folder), name.replace(", ", "_"), policy, flight_time)
            start = min(flown(app, 1) for _ in range(rounds))
            for missions in plans:
                yield name, missions, min(flown(app, missions) for _ in range(rounds)) - start


def compiled(folder: Path, name: str, policy: str, flight_time: str) -> Path:
    """Compile the app, and return its package."""
    source = folder / f"queue_{name}.pluto"
    text = SOURCE.format(name=source.stem, policy=policy, flight_time=flight_time)
    source.write_text(text)
    command = [sys.executable, "-m", "plutoc", "compile", str(source)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder / source.stem


def flown(package: Path, missions: int) -> float:
    """Simulate a plan of so many missions, as its user would; return the seconds of CPU."""
    goals = field(missions * TRIPS, seed=2, height=1.5)
    places = [(0.05 * x % 20, 0.05 * y % 20, z) for x, y, z in goals]
    plan, fleet = package / "missions.toml", package / "fleet.toml"
    plan.write_text("".join(map(mission, range(missions), _in_parts(places))))
    homes = [(2.0 * (n % 10) + 1.0, 2.0 * (n // 10) + 1.0) for n in range(DRONES)]
    # it is not their traffic that is measured
    fleet.write_text("[fleet]\napart = 0.0\n" + "".join(map(entry, range(DRONES), homes)))
    words = ["simulate", str(plan), "--fleet", str(fleet), "--json"]
    path = os.pathsep.join([str(package / "src"), os.environ.get("PYTHONPATH", "")])
    before = getrusage(RUSAGE_CHILDREN)  # in microseconds; os.times counts in hundredths
    subprocess.run(
        [sys.executable, "-m", package.name, *words],
        check=True,
        stdout=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": path},
    )
    after = getrusage(RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _in_parts(places: Sequence[Point]) -> Iterator[Sequence[Point]]:
    return (places[start : start + TRIPS] for start in range(0, len(places), TRIPS))


def mission(number: int, places: Sequence[Point]) -> str:
    """Return a mission of a missions file."""
    trips = (f'[[mission.trip]]\naction = "take_photo"\ntarget = {list(one)}\n' for one in places)
    return f'[[mission]]\nname = "{number}"\n' + "".join(trips)


def entry(number: int, home: tuple[float, float]) -> str:
    """Return a drone of a fleet file."""
    return f'[[drone]]\nid = "{number}"\ncategory = "quick"\nhome = {list(home)}\n'


def measure(given: argparse.Namespace, say: Callable[[str], None]) -> dict[str, Numbers]:
    """Measure everything, line by line."""
    told: dict[str, Numbers] = {"choice_us": {}, "share_ms": {}, "queue_s": {}}
    say(f"{'a choice':16}{'drones':>8}{'µs':>10}")
    for name, count, took in choices(given.rounds, given.fleets):
        told["choice_us"][f"{name} {count}"] = took
        say(f"{name:16}{count:8,}{took:10.1f}")
    say(f"\n{'all at once':16}{'trips':>8}{'drones':>8}{'ms':>12}")
    for waiting, free, took in shares(given.rounds, given.shares):
        told["share_ms"][f"{waiting} x {free}"] = took
        say(f"{'batch_optimal':16}{waiting:8,}{free:8,}{took:12.2f}")
    say(f"\n{'the queue':20}{'missions':>8}{'s':>10}{'a mission, to the first':>26}")
    base: Numbers = {}
    for policy, missions, took in queues(max(1, given.rounds // 2), given.plans):
        told["queue_s"][f"{policy} {missions}"] = took
        ratio = took / missions / base.setdefault(policy, took / missions)
        say(f"{policy:20}{missions:8,}{took:10.2f}{ratio:26.2f}")
    return told


def size(text: str) -> tuple[int, int]:
    """Read `TRIPSxDRONES`."""
    waiting, _, free = text.partition("x")
    return at_least_one(waiting), at_least_one(free)


def main() -> None:
    """Print tables, or JSON."""
    parser = argparse.ArgumentParser(description="What it costs to choose drones.")
    parser.add_argument("--rounds", type=at_least_one, default=7, help="each measures all once")
    parser.add_argument("--fleets", type=at_least_one, nargs="*", default=FLEETS, metavar="DRONES")
    parser.add_argument("--shares", type=size, nargs="*", default=SHARES, metavar="TRIPSxDRONES")
    parser.add_argument("--plans", type=at_least_one, nargs="*", default=PLANS, metavar="MISSIONS")
    parser.add_argument("--json", action="store_true", help="print one object instead of tables")
    given = parser.parse_args()
    told = measure(given, (lambda line: None) if given.json else partial(print, flush=True))
    if given.json:
        print(json.dumps(told, indent=2))


if __name__ == "__main__":
    main()
