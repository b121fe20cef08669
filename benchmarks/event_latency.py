"""How long does it take from an event by HTTP to a flying drone's new order?

`python benchmarks/event_latency.py` serves an app in real time with a simulated drone, which patrols, and raises an event by HTTP every
second, each at another place. The event breaks the drone's flight off, a creator makes a mission of it, and that drone is told to fly there.
Printed are the milliseconds from before the request was sent until the answer was there, and until the drone began its new leg, by its
journal: once with the journal on a disk, where the event and its mission are durable before the drone is told, and once
with it in memory (`/dev/shm`), where the same is written but nothing waits for a disk. Linux only.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from contextlib import closing
from pathlib import Path

from measuring.options import at_least_one
from pluto_fleet.journal.reader import Reader
from pluto_fleet.report.spread import spread
from watching.flight import RUNTIME
from watching.server import Server, serve

SOURCE = """\
pluto 1
app reacts "One drone that looks where something happens" {
  category scout(speed: 1 m/s, flight_time: 60 min) can take_photo
  event alarm
  creator look
  create = MissionCreator
  look_there = MissionCreator(hook: look)
  allocate = DroneAllocator(policy: nearest)
  launch = TripLauncher
  watch = TripMonitor
  alarmed = EventMonitor(event: alarm, of: any)
  first = GateFIFO
  retry = PriorityManager(max_attempts: 3)
  start -> create -> allocate
  alarm -> look_there -> allocate
  allocate -> launch -> [watch, alarmed] -> first
  first -> allocate when STANDBY
  first -> retry when FAILED
  retry -> allocate when STANDBY
  [first, retry] -> end otherwise
}
"""
HOOKS = '''\
"""The newest `alarm` comes first: they come from outside."""

from . import AlarmEvent, Context, Mission, Trip


def look(event: AlarmEvent, context: Context) -> Mission | None:
    """Look where it is; those before it wait."""
    priority = len(context.missions)
    trip = Trip(name="look", action="take_photo", target=event.at, priority=priority)
    return Mission(name=event.id, trips=[trip])
'''
SIDE = 60.0
FLEET = f"""\
[map]
size = [{SIDE}, {SIDE}]

[[drone]]
id = "cf1"
home = [1.0, 1.0]
"""
EVERY = 1.0
"""Seconds between two events: the drone is under way to the one before."""
IN_MEMORY = Path("/dev/shm")


def compiled(folder: Path) -> Path:
    """Compile the app, and return where its package is imported from."""
    (folder / "reacts.pluto").write_text(SOURCE)
    (folder / "hooks.py").write_text(HOOKS)
    compiler = [sys.executable, "-m", "plutoc", "compile", str(folder / "reacts.pluto")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    subprocess.run(compiler, check=True, env=environment, stdout=subprocess.DEVNULL)
    return folder / "reacts" / "src"


def place(number: int) -> tuple[float, float]:
    """Return where an event happens: no two at one place, and each far from the next."""
    return 10.0 + number * 0.1, 50.0 if number % 2 else 10.0


def raised(server: Server, count: int) -> tuple[dict[int, float], list[float]]:
    """Raise so many events; return when each was sent, since 1970, and how many seconds it took to be answered."""
    sent: dict[int, float] = {}
    answered: list[float] = []
    for number in range(count):
        given = {"at": [*place(number)], "id": f"alarm {number}"}
        sent[number] = time.time()
        server.ask("/api/events/alarm", given, "POST")
        answered.append(time.time() - sent[number])
        time.sleep(EVERY)
    return sent, answered


def told(journals: Sequence[Path]) -> dict[tuple[float, float], float]:
    """Return when the drone began each of its legs, since 1970, by where they lead."""
    began: dict[tuple[float, float], float] = {}
    for journal in journals:
        with closing(Reader(journal)) as reader:
            zero = 0.0
            for _, entry in reader.events():
                if entry["event"] == "brain.began":
                    zero = entry["began"]
                if entry["event"] == "drone.flew" and entry["what"] == "leg":
                    x, y, _ = entry["to"]
                    where = round(x, 3), round(y, 3)
                    began.setdefault(where, zero + entry["t"] - entry["seconds"])
    return began


def measured(
    sources: Sequence[Path], fleet: Path, folder: Path, count: int
) -> Mapping[str, object]:
    """Serve in a folder, raise events, and return how long it took."""
    server = serve(sources, fleet, folder, app="reacts")
    try:
        plan = {"revision": server.ask("/api/plan")["revision"]}
        trips: list[dict[str, object]] = [
            {
                "key": f"trip{n:06}",
                "name": f"{n}",
                "action": "take_photo",
                "target": [SIDE / 2, 5.0 + n],
                "parameters": {},
                "item": None,
            }
            for n in range(50)
        ]
        missions = [{"key": "mission00", "name": "patrol", "trips": trips}]
        server.ask("/api/plan", {**plan, "missions": missions}, "PUT")
        server.ask("/api/start", {"id": "start"}, "POST")
        time.sleep(5.0)  # until it flies
        sent, answered = raised(server, count)
        time.sleep(EVERY)
    finally:
        server.end()
    began = told(sorted(folder.glob("**/*.journal")))
    ordered = [
        began[place(number)] - when for number, when in sent.items() if place(number) in began
    ]
    if len(ordered) < count:
        print(f"{count - len(ordered)} of {count} events led to no new leg", file=sys.stderr)
    return {
        "answered_ms": spread(1000 * one for one in answered),
        "ordered_ms": spread(1000 * one for one in ordered),
        "count": len(ordered),
    }


def main() -> None:
    """Print both, or JSON."""
    parser = argparse.ArgumentParser(description="From an event by HTTP to a drone's new order.")
    parser.add_argument("--events", type=at_least_one, default=100, help="in each of the two")
    parser.add_argument("--json", action="store_true", help="print one object instead of lines")
    given = parser.parse_args()
    found: dict[str, Mapping[str, object]] = {}
    with tempfile.TemporaryDirectory() as name, tempfile.TemporaryDirectory(dir=IN_MEMORY) as fast:
        folder = Path(name)
        sources = [RUNTIME, compiled(folder)]
        (folder / "fleet.toml").write_text(FLEET)
        for what, where in (("durable", folder), ("in memory", Path(fast))):
            found[what] = measured(sources, folder / "fleet.toml", where / "station", given.events)
    if given.json:
        print(json.dumps(found, indent=2))
        return
    for what, one in found.items():
        for key, says in (("answered_ms", "answered"), ("ordered_ms", "drone told")):
            figures = one[key]
            assert isinstance(figures, dict)
            numbers = f"{figures['median']:8.1f} ms{figures['p95']:8.1f} ms{figures['max']:8.1f} ms"
            print(f"{what:12}{says:12}{numbers}")


if __name__ == "__main__":
    main()
