"""What does it cost to watch, and how old is what one sees?

`python benchmarks/station.py` serves a compiled app in real time with simulated drones: 50 drones fly,
200 missions want them, and three browsers look at the Monitor. It prints how much of a core the
server takes without and with three browsers, how much of its main thread each browser, how old
what they show is, how large journals become, what a client costs that asks and never reads, and how long one waits for the
first paint and for the first drone after Start, of a library that is installed as users have it. Needs Chromium, and what the extra `test` installs. Linux only: it reads /proc.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import median, quantiles

from playwright.sync_api import Browser

from measuring.options import at_least_one
from watching.flight import compiled, fleet, installed, plan
from watching.idler import idler
from watching.server import Server, seconds_of, serve
from watching.tabs import Tab, browser, first_drone, first_visit, main_threads, opened
from watching.weight import kilobytes

Numbers = dict[str, float]

SETTLE = 5.0
"""Seconds until what has just begun is steady; never longer than what is measured then."""


def share(used: Callable[[], float], seconds: float) -> float:
    """Return how much of these seconds was used, in per cent."""
    before, begun = used(), time.perf_counter()
    time.sleep(seconds)
    return 100 * (used() - before) / (time.perf_counter() - begun)


def airborne(server: Server, drones: int) -> None:
    """Wait until so many drones fly or all that can."""
    end = time.monotonic() + 60
    while time.monotonic() < end:
        live = server.ask("/api/live?flight=&seen=0&log=0&results=0")
        if sum(row["mission"] is not None for row in live["drones"]) >= drones:
            return
        time.sleep(0.5)


def watched(server: Server, found: Browser, tabs: int, seconds: float) -> Numbers:
    """Measure with so many browsers: first what they cost, then how old what they show is."""
    url = server.url + "/"
    quiet = [opened(found, url, listening=False) for _ in range(tabs)]
    time.sleep(min(SETTLE, seconds))
    before, begun = main_threads(found), time.perf_counter()
    numbers = {"server, watched, %": share(lambda: server.used, seconds)}
    after, took = main_threads(found), time.perf_counter() - begun
    busy = [100 * (used - before[process]) / took for process, used in after.items()]
    numbers["main thread of a browser, most, %"] = max(busy)
    for tab in quiet:
        tab.page.context.close()
    listening = [opened(found, url, listening=True) for _ in range(tabs)]
    time.sleep(min(SETTLE, seconds))
    numbers.update(_ages(listening, seconds))
    for tab in listening:
        tab.page.context.close()
    return numbers


def _ages(tabs: Sequence[Tab], seconds: float) -> Numbers:
    before = [tab.ages()[1] for tab in tabs]
    time.sleep(seconds)
    after = [tab.ages() for tab in tabs]
    ages = [age for some, _ in after for age in some]
    updates = [now - was for (_, now), was in zip(after, before, strict=True)]
    return {
        "updates a second, least": min(updates) / seconds,
        "age of what is shown, p50, ms": median(ages),
        "age of what is shown, p95, ms": quantiles(ages, n=100)[94],
        "age of what is shown, most, ms": max(ages),
    }


def neglected(server: Server, seconds: float) -> Numbers:
    """Measure what a client costs that never reads, and what it sees at last."""
    memory = server.memory
    with idler(server.url) as back:
        time.sleep(min(SETTLE, seconds))
        used = share(lambda: server.used, seconds)
        grown = server.memory - memory
        newest = server.ask("/api/live?flight=&seen=0&log=0&results=0")["version"]
        behind = newest - back()
    return {
        "server, a client never reads, %": used,
        "memory that it costs, MB": grown,
        "versions that it is behind when it reads again": max(0, behind),
    }


def measure(given: argparse.Namespace, say: Callable[[str], None]) -> Numbers:
    """Measure everything, line by line."""
    numbers: Numbers = {}

    def tell(some: Numbers) -> None:
        for name, number in some.items():
            say(f"{name:50}{number:12,.2f}")
        numbers.update(some)

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        library = installed(folder)
        tell(kilobytes(library))
        sources = [library, compiled(folder)]
        (folder / "fleet.toml").write_text(fleet(given.drones))
        server = serve(sources, folder / "fleet.toml", folder / "station")
        try:
            tell({"from serve to its address, s": server.started_in})
            visit = first_visit(server.url + "/")
            tell({"from there to the first paint, s": visit.painted})
            tell({"over the line for a first visit, kB": visit.kilobytes})
            tell({"requests of a first visit": visit.requests})
            missions = {"revision": server.ask("/api/plan")["revision"]}
            server.ask("/api/plan", {**missions, "missions": plan(given.missions)}, "PUT")
            tell({"from Start to the first drone on the map, s": first_drone(server.url + "/")})
            airborne(server, given.drones)
            time.sleep(min(SETTLE, given.seconds))
            gateway = server.gateway()
            before = server.kept
            tell({"server, no browser, %": share(lambda: server.used, given.seconds)})
            hourly = (server.kept - before) / given.seconds * 3600
            tell({"journal, no browser, MB an hour": hourly})
            if gateway is not None:
                tell({"gateway, %": share(lambda: seconds_of(gateway), given.seconds)})
            with browser() as found:
                before = server.kept
                begun = time.perf_counter()
                tell(watched(server, found, given.tabs, given.seconds))
                hourly = (server.kept - before) / (time.perf_counter() - begun) * 3600
                tell({"journal, watched, MB an hour": hourly})
            tell(neglected(server, given.seconds))
        finally:
            server.end()
    return numbers


def main(arguments: Sequence[str] | None = None) -> None:
    """Print lines, or JSON."""
    parser = argparse.ArgumentParser(description="What it costs to watch a flight.")
    parser.add_argument("--drones", type=at_least_one, default=50)
    parser.add_argument("--missions", type=at_least_one, default=200)
    parser.add_argument("--tabs", type=at_least_one, default=3, help="browsers that look")
    parser.add_argument("--seconds", type=float, default=20.0, help="of each measurement")
    parser.add_argument("--json", action="store_true", help="print one object instead of lines")
    given = parser.parse_args(arguments)
    numbers = measure(given, (lambda line: None) if given.json else print)
    if given.json:
        print(json.dumps(numbers, indent=2))


if __name__ == "__main__":
    main()
