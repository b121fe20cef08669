"""What does it cost to write everything down, and how long does an app take to go on?

`python benchmarks/journal.py` prints three tables. *Writing*: durable rows a second, one by one and
in groups. *Flying*: transitions a second of an app in real time whose drones are there at once, with
as many missions in flight, each of them waiting for the journal. *Going on*: seconds from a journal
of a large plan, all of which was flown, to where everything stands.

The parts run round after round; the best of each counts. With `--json` the numbers come as JSON.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from functools import partial
from pathlib import Path

from measuring.instant import APP, Instant, ground, plan
from measuring.options import at_least_one
from pluto_fleet.flight.recorded_flight import RecordedFlight
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.standing import Standing
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.journal.writer import Writer
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.time.kernel import FLEET, EventKind
from pluto_fleet.shared.time.told import VirtualTime

HEADER = {"t": 0.0, "event": "journal.begun", "app": APP.name}
GROUPS = (1, 10, 100, 1_000)
MISSIONS, TRIPS = 10_000, 10
IN_FLIGHT = 100
ENTRY = Entry(
    json.dumps(
        [
            {
                "t": 12.345678,
                "event": "trip.launched",
                "mission": "North field",
                "trip": "A",
                "drone": "cf1",
                "round": 0,
                "attempt": 1,
            }
        ]
    )
)

Numbers = dict[str, float]


def writing(folder: Path, seconds: float) -> Iterator[tuple[int, float]]:
    """Give the size of a group, and durable rows a second."""
    for group in GROUPS:
        store = Store.create(folder / f"{group}.journal", HEADER)
        entries = [ENTRY] * group
        count = 0
        begun = time.perf_counter()
        while time.perf_counter() - begun < seconds:
            store.append(entries)
            count += group
        yield group, count / (time.perf_counter() - begun)
        store.close()


def flying(folder: Path, missions: int) -> tuple[float, float]:
    """Return transitions a second, durable ones, and how many rows went into a commit."""
    store = Store.create(folder / "flown.journal", HEADER)
    commits: list[int] = []

    async def fly() -> float:
        kernel, loop = RealTime(), asyncio.get_running_loop()
        drones = Instant(kernel, IN_FLIGHT)
        standing = Standing()

        def durable(number: int) -> None:
            commits.append(number)
            loop.call_soon_threadsafe(kernel.post, life.recorder.durable, number)

        writer = Writer(store, durable, print)
        life = RecordedFlight(
            APP, ground(IN_FLIGHT), kernel, drones, writer, standing, epoch=store.epoch
        )
        begun = time.perf_counter()
        await kernel.run(life.start(plan(missions, TRIPS)))
        writer.flush()
        took = time.perf_counter() - begun
        writer.close()
        kernel.close()
        return took

    took = asyncio.run(fly())
    with closing(Reader(store.path)) as reader:
        events = sum(1 for _ in reader.events())
    rate, rows = events / took, store.seq / len(commits)
    store.close()
    return rate, rows


def written(path: Path, missions: int) -> int:
    """Write the journal of a plan that was flown, and return the number of its events."""
    store = Store.create(path, HEADER)
    kernel = VirtualTime()
    entries = list[Entry]()

    class Sink:
        def add(self, entry: Entry) -> int:
            entries.append(entry)
            durable = partial(life.recorder.durable, len(entries))
            kernel.at(kernel.now, EventKind.READY, FLEET, durable)
            return len(entries)

    standing = Standing()
    drones = Instant(kernel, IN_FLIGHT)
    life = RecordedFlight(APP, ground(IN_FLIGHT), kernel, drones, Sink(), standing, epoch=1)
    kernel.run(life.start(plan(missions, TRIPS)), None)
    kernel.close()
    store.append(entries)
    store.close()
    return sum(len(json.loads(entry.events)) for entry in entries)


def going_on(path: Path, rounds: int) -> tuple[float, float]:
    """Return the least seconds, and of CPU, to open a journal and read where everything stands."""
    took, used = [], []
    for _ in range(rounds):
        begun, idle = time.perf_counter(), time.process_time()
        store = Store.open(path)
        standing = store.standing()
        took.append(time.perf_counter() - begun)
        used.append(time.process_time() - idle)
        store.close()
        del standing
    return min(took), min(used)


def measure(given: argparse.Namespace, say: Callable[[str], None]) -> Numbers:
    """Measure everything, line by line."""
    told: Numbers = {}
    with tempfile.TemporaryDirectory(dir=given.folder) as name:
        folder = Path(name)
        say(f"{'writing':30}{'durable rows/s':>16}")
        for group, rate in writing(folder, given.seconds):
            told[f"rows a second, in groups of {group}"] = rate
            say(f"{f'in groups of {group}':30}{rate:16,.0f}")
        rate, rows = flying(folder, given.missions)
        told["transitions a second"] = rate
        say(f"\n{'flying':30}{'transitions/s':>16}{'rows a commit':>16}")
        say(f"{f'{IN_FLIGHT} missions in flight':30}{rate:16,.0f}{rows:16.1f}")
        path = folder / "large.journal"
        events = written(path, given.missions)
        size = path.stat().st_size / 1e6
        say(f"\n{'going on':30}{'s':>16}{'of CPU':>16}{'events':>16}{'MB':>16}")
        took, used = going_on(path, given.rounds)
        told["seconds to go on"] = took
        told["of CPU, to go on"] = used
        say(f"{'from its rows':30}{took:16.2f}{used:16.2f}{events:16,}{size:16.1f}")
    return told


def main(arguments: Sequence[str] | None = None) -> None:
    """Print tables, or JSON."""
    parser = argparse.ArgumentParser(description="What a journal costs.")
    parser.add_argument("--rounds", type=at_least_one, default=5, help="the best one counts")
    parser.add_argument("--seconds", type=float, default=2.0, help="how long to write a group size")
    parser.add_argument("--missions", type=at_least_one, default=MISSIONS, help="of the large plan")
    parser.add_argument("--folder", type=Path, help="on which disk; default: that of /tmp")
    parser.add_argument("--json", action="store_true", help="print one object instead of tables")
    given = parser.parse_args(arguments)
    told = measure(given, (lambda line: None) if given.json else partial(print, flush=True))
    if given.json:
        print(json.dumps(told, indent=2))


if __name__ == "__main__":
    main()
