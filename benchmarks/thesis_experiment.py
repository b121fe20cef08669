"""The thesis's own experiment (6.3.3): what does the system cost while drones fly in real time?

10 missions of 5 trips, 15 drones, flights of about 2 s, in real time with simulated drones. The
thesis measured 95 % of the CPU with a thread for every mission and trip. This compiles the graph
below, flies it with `fly --sim` as a process of its own, and prints the process's CPU time as a
share of one core and the largest number of its threads. Linux only: it reads /proc.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from argparse import ArgumentParser
from pathlib import Path

SOURCE = """\
pluto 1
app experiment "The thesis's experiment" {
  category quick(speed: 10 m/s) can take_photo
  create = MissionCreator
  allocate = DroneAllocator(policy: first)
  launch = TripLauncher
  watch = TripMonitor
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end otherwise
}
"""

MISSIONS, TRIPS, DRONES = 10, 5, 15


def missions() -> str:
    """Return the missions file: each trip is a flight of about 2 s."""
    tables = []
    for mission in range(MISSIONS):
        tables.append(f'[[mission]]\nname = "mission {mission + 1}"\n')
        tables += [
            f'[[mission.trip]]\naction = "take_photo"\ntarget = [{2 + trip}.0, {mission + 2}.0]\n'
            for trip in range(TRIPS)
        ]
    return "\n".join(tables)


def fleet() -> str:
    """Return the fleet file: fifteen drones that rise 0.15 m."""
    tables = ["[map]\nsize = [20.0, 20.0]\ncruise_height = 0.15\n"]
    tables += [
        f'[[drone]]\nid = "cf{n + 1}"\ncategory = "quick"\nhome = [{n + 1}.0, 0.5]\n'
        for n in range(DRONES)
    ]
    return "\n".join(tables)


def threads(process: int) -> int:
    """Return how many threads a process has; 0 when it is gone."""
    try:
        return len(os.listdir(f"/proc/{process}/task"))
    except FileNotFoundError:
        return 0


def main() -> int:
    """Compile, fly, measure, print."""
    parser = ArgumentParser(description="The thesis's own experiment, flown in real time.")
    parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        (home / "experiment.pluto").write_text(SOURCE)
        (home / "missions.toml").write_text(missions())
        (home / "fleet.toml").write_text(fleet())
        compiler = [sys.executable, "-m", "plutoc", "compile", str(home / "experiment.pluto")]
        subprocess.run(compiler, check=True)
        flight = [sys.executable, "-m", "experiment", "fly", str(home / "missions.toml")]
        flight += ["--fleet", str(home / "fleet.toml"), "--sim"]
        environment = {**os.environ, "PYTHONPATH": str(home / "experiment" / "src")}
        before, most, began = os.times(), 0, time.monotonic()
        running = subprocess.Popen(flight, env=environment, stdout=subprocess.DEVNULL)
        while running.poll() is None:
            most = max(most, threads(running.pid))
            time.sleep(0.05)
        wall, after = time.monotonic() - began, os.times()
    cpu = after.children_user + after.children_system
    cpu -= before.children_user + before.children_system
    print(f"{MISSIONS} missions × {TRIPS} trips, {DRONES} drones, in real time: {wall:.1f} s")
    print(f"CPU {cpu:.2f} s, start of Python included: {cpu / wall:.1%} of a core (thesis: 95 %)")
    print(f"most threads at once: {most} (thesis: one for each mission and each trip)")
    return running.returncode


if __name__ == "__main__":
    raise SystemExit(main())
