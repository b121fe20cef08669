"""Floods a running station with forged files and hostile clients, and counts what it costs the others.

    python -m tests.forged.floods

Beside its journal lie others that were written to do harm, and all is asked of them; strangers hold connections, and
send halves, depths and lengths. Meanwhile its own page reads, and at the end a Stop is taken.
"""

from __future__ import annotations

import http.client
import json
import socket
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import cycle
from pathlib import Path
from tempfile import TemporaryDirectory

from pluto_fleet.journal.store import Store
from tests.forged.files import DEEP, write_events
from tests.kit.campaign import Campaign
from tests.kit.station import Station, Stations, until

SECONDS = 20.0
FEWEST = 5
"""Questions about forged files that a flood has at least, however slow the machine is."""
LONGEST = 120.0
"""Seconds after which a flood ends all the same."""
IDLE = 300
"""Connections that say nothing: more than a station has."""
MOST_MEMORY = 1024
"""MiB that a station may have grown by: the largest file here has 60 MiB of text in a row."""
BOMB = 60 * 1024 * 1024


@dataclass
class Figures:
    """What it has come to."""

    answers: int = 0
    slowest: float = 0.0
    stop: float = 0.0
    """Seconds until a Stop was answered."""
    memory: int = 0
    """MiB at most of all its processes, beside what they had before."""
    asked: int = 0
    """Of forged files."""
    faults: list[str] = field(default_factory=list)


def flooded(seconds: float = SECONDS) -> Figures:
    """Flood a station for some seconds."""
    with TemporaryDirectory() as folder:
        stations = Stations(Path(folder))
        station = stations.fresh("pm10")
        try:
            station.start()
            return _flood(station, seconds)
        finally:
            station.end()
            stations.end()


def _flood(station: Station, seconds: float) -> Figures:
    figures = Figures()
    if not station.missions:
        station.post("/api/plan/example", {"revision": station.get("/api/plan")["revision"]})
    station.tell("start")
    until(lambda: station.phase == "flying", "it flies")
    journal = station.journals()[0]
    ids = _forge(journal.parent)
    before = _peak(station.pid)
    over = threading.Event()
    floods = [*(_idle, _bodies), *[_asks(ids, figures)] * 2]
    threads = [threading.Thread(target=one, args=(station.port, over)) for one in floods]
    for thread in threads:
        thread.start()
    begun = time.monotonic()
    while (since := time.monotonic() - begun) < seconds or (
        figures.asked <= FEWEST and since < LONGEST
    ):
        asked = time.monotonic()
        station.now()
        station.get("/api/plan")
        figures.answers += 2
        figures.slowest = max(figures.slowest, time.monotonic() - asked)
        time.sleep(0.1)
    asked = time.monotonic()
    station.tell("stop", how="land")
    figures.stop = time.monotonic() - asked
    over.set()
    for thread in threads:
        thread.join()
    figures.memory = _peak(station.pid) - before
    if "Traceback" in station.said():
        figures.faults.append(station.said())
    figures.faults += [str(one["trouble"]) for one in station.audit() if "trouble" in one]
    return figures


def _forge(folder: Path) -> list[str]:
    """Write files beside a journal; return the ids of their flights."""
    header = json.dumps([{"t": 0.0, "event": "journal.begun", "app": "pm10", "sim": True}])
    lists = "[]," * (BOMB // 3) + "[]"
    rows = {
        "text": json.dumps([{"t": 1, "event": "log", "text": "x" * BOMB}]),
        "parts": '[{"t": 1, "event": "log", "text": "", "a": [' + lists + "]}]",
        "late": json.dumps([{"t": 9e8, "event": "brain.began", "epoch": 1}]),
        "nested": DEEP,
        "junk": json.dumps([{"t": 1, "event": "shown", "drones": {"d": {"x": "far"}}}] * 100_000),
    }
    for id, text in rows.items():
        path = folder / f"{id}.journal"
        Store.create(path, {"event": "journal.begun"}).close()
        write_events(path, [header, text])
    return [*rows]


def _peak(process: int) -> int:
    """Return the most MiB that a process had, and each that it has begun."""
    about = Path(f"/proc/{process}")
    try:
        status = (about / "status").read_text()
        begun = (about / f"task/{process}/children").read_text().split()
    except FileNotFoundError:  # it has just ended
        return 0
    own = [line.split()[1] for line in status.splitlines() if line.startswith("VmHWM")]
    return sum(map(int, own)) // 1024 + sum(map(_peak, map(int, begun)))


def _asks(ids: list[str], figures: Figures) -> Callable[[int, threading.Event], None]:
    """Ask everything of the forged flights, one after the other."""
    asks = (
        *("flights/replay", "flights/report", "flights/mcap", "flights", "drones/hours"),
        *("console.txt", "results.csv", "results.json"),
    )

    def ask(port: int, over: threading.Event) -> None:
        for id, what in cycle([(id, what) for id in ids for what in asks]):
            if over.is_set():
                return
            line = http.client.HTTPConnection("127.0.0.1", port, timeout=120)
            with suppress(OSError, http.client.HTTPException):
                line.request("GET", f"/api/{what}?flight={id}&start=0", headers={"X-Pluto": "1"})
                answer = line.getresponse()
                answer.read()
                figures.asked += 1
                if answer.status >= 500 and answer.status != 503:
                    figures.faults.append(f"{what} of {id}: {answer.status}")
            line.close()

    return ask


def _idle(port: int, over: threading.Event) -> None:
    """Hold connections that say nothing."""
    lines = deque[socket.socket]()
    while not over.wait(0.01):
        with suppress(OSError):
            lines.append(socket.create_connection(("127.0.0.1", port), 1))
        _close(lines, all_but=IDLE)
    _close(lines)


def _bodies(port: int, over: threading.Event) -> None:
    """Send what is too deep, too long, or no JSON, and requests that never end."""
    bodies = cycle([DEEP[:100_000].encode(), b"x" * 2_000_000, b'{"id": 1e999}', None])
    lines = deque[http.client.HTTPConnection]()
    while not over.wait(0.02):
        body = next(bodies)
        line = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
        lines.append(line)
        kind = {"X-Pluto": "1", "Content-Type": "application/json"}
        with suppress(OSError, http.client.HTTPException):
            if body is None:
                line.putrequest("POST", "/api/start")
                line.send(b"Content-Length: 999999\r\n")
            else:
                line.request("POST", "/api/pause", body, kind)
                line.getresponse().read()
        _close(lines, all_but=100)
    _close(lines)


def _close(
    lines: deque[socket.socket] | deque[http.client.HTTPConnection], all_but: int = 0
) -> None:
    """Close the oldest of these connections."""
    while len(lines) > all_but:
        lines.popleft().close()


def main() -> int:
    """Flood one, and say what it has cost."""
    campaign = Campaign("tests.forged.floods", __doc__)
    campaign.option("--seconds", type=float, default=SECONDS)
    figures = flooded(campaign.parse().seconds)
    for fault in dict.fromkeys(figures.faults):
        campaign.found(fault)
    return campaign.over(
        f"{figures.answers} answers to its own page, the slowest after {figures.slowest:.1f} s;"
        f" a Stop after {figures.stop:.1f} s;"
        f" {figures.asked} questions about forged files; {figures.memory} MiB more at most"
    )


if __name__ == "__main__":
    sys.exit(main())
