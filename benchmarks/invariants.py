"""How many missions a second are tried: with a journal, with faults, and held against all rules.

    python benchmarks/invariants.py

A thousand missions of three trips fly in virtual time. Every instant is a row of a journal, flights
fail and are flown again, the brain crashes once and goes on, and every event is held against
what no run may do. Times are those of the CPU, the best of some runs. The trace has the same hash
for every seed of Python's own hashes: `--hash` prints it.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from hashlib import sha256
from pathlib import Path
from random import Random

sys.path[:0] = [str(Path(__file__).parents[1])]

import tests  # noqa: F401  # first: all that follows shares one brain
from pluto_fleet.app import App
from pluto_fleet.files.fleet import DroneEntry, FleetFile
from pluto_fleet.journal.event_line import line
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fleet_data import WorldData
from pluto_fleet.shared.domain.model import AfterTrip
from pluto_fleet.trials.case import Case, Weather, strikes_of
from pluto_fleet.trials.lives import tried
from pluto_fleet.trials.record import TrialResult
from tests.trials.examples import app_of

APP = """pluto 1

app many {
  category scout(flight_time: 30 min) can take_photo

  create = MissionCreator
  wait = Clock
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  timer = TimerMonitor(default: 5 min)
  first = GateFIFO
  retry = PriorityManager(max_attempts: 5)

  start -> create -> wait -> allocate -> launch -> [watch, timer] -> first
  first -> wait when STANDBY
  first -> end when COMPLETED
  first -> retry when FAILED
  retry -> wait when STANDBY
  retry -> end otherwise
}
"""
SIDE = 60.0
BLOWS = "crash@400"


def case_of(app: App, missions: int, trips: int, drones: int) -> Case:
    """Return the missions, somewhere on a large field."""
    chance = Random(1)

    def spot() -> tuple[float, float, float]:
        return round(chance.uniform(1, SIDE - 1), 1), round(chance.uniform(1, SIDE - 1), 1), 1.2

    flown = [
        app.mission(
            name=f"m{number}",
            index=number,
            trips=[
                app.trip(name=str(place), action="take_photo", target=spot(), index=place)
                for place in range(trips)
            ],
        )
        for number in range(missions)
    ]
    homes = [(1 + number % 57, 1.0 + number // 57, 0.0) for number in range(drones)]
    fleet = FleetFile(
        airspace=Airspace(size=(SIDE, SIDE)),
        drones=tuple(
            DroneEntry(id=f"d{number}", category="scout", home=home)
            for number, home in enumerate(homes)
        ),
        after_trip=AfterTrip.STAY,
        apart=0.0,  # a thousand drones at once: it is not their traffic that is measured
        world=WorldData(),  # nothing to see: nor is it photos
    )
    weather = Weather(link=0.01, action=0.01, battery=0.01)
    return Case(
        seed=1, missions=tuple(flown), fleet=fleet, weather=weather, strikes=strikes_of(BLOWS)
    )


def hash_of(trial: TrialResult) -> str:
    """Return the hash of everything that is on record."""
    digest = sha256()
    for event in trial.events:
        digest.update(line(event).encode())
    return digest.hexdigest()[:16]


def hashes(missions: int, trips: int, drones: int) -> list[str]:
    """Return the hash under three seeds of Python's own hashes."""
    found = []
    sizes = ("--missions", str(missions), "--trips", str(trips), "--drones", str(drones))
    for seed in ("0", "1", "4711"):
        command = [sys.executable, __file__, "--hash", *sizes]
        paths = os.pathsep.join(sys.path)
        environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": paths}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        found.append(done.stdout.strip())
    return found


def main() -> int:
    """Fly, measure and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--missions", type=int, default=1000)
    parser.add_argument("--trips", type=int, default=3)
    parser.add_argument("--drones", type=int, default=1000)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--hash", action="store_true", help="print the trace's hash, and no more")
    options = parser.parse_args()
    app = app_of(APP)
    case = case_of(app, options.missions, options.trips, options.drones)
    if options.hash:
        print(hash_of(tried(app, case)))
        return 0
    best = float("inf")
    for _ in range(options.runs):
        began = time.process_time()
        trial = tried(app, case)
        best = min(best, time.process_time() - began)
    print(
        f"{options.missions} missions × {options.trips} trips, {len(trial.events)} events in "
        f"{trial.rows} rows, {trial.lives} lives, {dict(sorted(trial.fired.items()))}"
    )
    print(f"{len(trial.violations)} violations")
    print(f"{options.missions / best:.0f} missions a second of CPU ({best:.2f} s)")
    found = hashes(options.missions, options.trips, options.drones)
    print(f"trace hash under three PYTHONHASHSEEDs: {', '.join(found)}")
    return 1 if trial.violations or len(set(found)) > 1 else 0


if __name__ == "__main__":
    sys.exit(main())
