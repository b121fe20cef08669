"""Flies random plans by real processes, beside a load: waits of which nothing was said, and trips that failed by our own lag.

    python -m tests.waits --flights 6 --load 8
    python -m tests.waits --flights 6 --crtp --load 8 --stall 4

What waited is judged by the events of the journal alone: a mission between two flights, a drone that is under way and
commanded nothing. Each wait of more than ten seconds must have its line, in the journal and on the console. A trip may
fail only by what was let befall its drone: not by a load, nor by a gateway that was stopped for some seconds.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from random import Random
from tempfile import mkdtemp
from typing import Any

from pluto_fleet.files.plan_check import LONG
from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.journal.reader import Reader
from pluto_fleet.report.sentences import line_of
from pluto_fleet.shared.domain.errors import BadInput
from tests.flights_crazyflie.flight import Flight as Crazyflies
from tests.kill.lives import Flight, Lives
from tests.kill.trial import gateway_of
from tests.kit.apps import compiled_file
from tests.kit.campaign import Campaign

Event = Mapping[str, Any]

APP = """pluto 1
app waiting {
  category scout(flight_time: 3 min, charge_time: 4 min) can take_photo, measure
  create = MissionCreator
  wait = Clock
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager
  start -> create -> wait -> allocate -> launch -> watch
  [watch, retry] -> wait when STANDBY
  watch -> retry when FAILED
  [watch, retry] -> end otherwise
}
"""
SPEED = 5
CRAZYFLIES = 3
PATIENCE = 900.0
"""Seconds of real time for one flight."""
UP = 1.0
"""Metres of height from which on a fault befalls a drone."""
BETWEEN_STALLS = 12.0
"""Seconds from one stall of the gateway to the next."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """What befalls some Crazyflies once one is in the air."""

    name: str
    value: float | bool = True
    drones: int = 1
    seconds: float | None = None
    """After which it is over; None: it stays."""
    fails: str | None = None
    """What the reason of a trip that failed by it must match; None: none may fail."""


FAULTS = (
    Fault(name="tumble", drones=2, fails="crashed"),
    Fault(name="level", value=0.3, drones=3, fails="battery"),
    Fault(name="silent", fails="link|answer|silent|heard"),
    Fault(name="fixes", value=False, fails="does not know where it is"),
    Fault(name="silent", drones=3, seconds=1.5),
    Fault(name="lock", fails="lock"),
)
"""One in each flight, in turn."""
_CHANCE = "crash=10%,link=10%"
_CHANCED = r"cf\d (crashed|lost its link) at"
"""What the reason of a trip must match that failed by this chance."""
_STALLED = re.compile(r"was kept from watching its drones for ([0-9.]+) s")
_BUSY = "while True: pass"
_ENDS = ("trip.completed", "trip.failed", "trip.interrupted")
_UNDER_WAY = ("trip.launched", "drone.returning", "drone.recovering", "drone.busy")
_SETTLED = ("drone.free", "drone.charging", "drone.lost", "drone.offline")


@dataclass(slots=True, kw_only=True)
class Came:
    """What came of a flight."""

    told: int = 0
    """How many waits and landings."""
    trips: int = 0
    failed: int = 0
    lag: float = 0.0
    """The longest time for which the gateway says that it did not watch its drones, in seconds."""
    wrong: list[str] = field(default_factory=list)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; 1 if a wait was not told, or a trip failed by our own lag."""
    campaign = Campaign("tests.waits", __doc__)
    campaign.draws("flights", 6)
    campaign.option("--load", type=int, default=0, metavar="N", help="busy loops beside them")
    campaign.option("--crtp", action="store_true", help="with Crazyflies, simulated to their radio")
    campaign.option(
        *("--stall", "--stalls"),
        type=float,
        default=0.0,
        metavar="SECONDS",
        help="now and then the gateway is stopped for so long",
    )
    options = campaign.parse(arguments)
    all = Came()
    one = partial(fly, load=options.load, crtp=options.crtp, stall=options.stall)
    for number, came in campaign.each(one, campaign.numbers):
        all.told += came.told
        all.trips += came.trips
        all.failed += came.failed
        all.lag = max(all.lag, came.lag)
        if came.wrong:
            campaign.found(f"flight {number}", *came.wrong)
    return campaign.over(
        f"{all.trips} trips were launched, {all.failed} failed by what befell their drones",
        f"the longest lag of a gateway was {all.lag:g} s",
        f"{all.told} waits and landings were told",
    )


def fly(number: int, *, load: int, crtp: bool, stall: float = 0.0) -> Came:
    """Fly a plan to its end; return how much was told, and what was not, or is wrong."""
    folder = Path(mkdtemp(prefix=f"waits{number}_"))
    (folder / "app.pluto").write_text(APP)
    source = compiled_file(folder / "app.pluto", folder / "package") / "src"
    dice = Random(f"waits/{number}")
    missions = _missions(dice, 3, 2) if crtp else _missions(dice, 6, 3)
    (folder / "missions.toml").write_text("\n".join(missions))
    homes = [f'[[drone]]\nid = "cf{n}"\nhome = [{n}, 0.5]' for n in range(1, CRAZYFLIES + 1)]
    (folder / "fleet.toml").write_text("\n".join(["[map]\nsize = [9, 9]", *homes]))
    flight: Lives
    if crtp:
        flight = Crazyflies(app="waiting", source=source, folder=folder, drones=CRAZYFLIES)
    else:
        chance = ["--fail", _CHANCE, "--seed", str(number)]
        flight = Flight(app="waiting", source=source, folder=folder, speed=SPEED, chance=chance)
    fault = FAULTS[number % len(FAULTS)]
    struck: Sequence[str] = ()
    with ExitStack() as stack:
        for _ in range(load):
            busy = stack.enter_context(subprocess.Popen([sys.executable, "-c", _BUSY]))
            stack.callback(busy.kill)
        stack.callback(flight.end)
        flight.start()
        if isinstance(flight, Crazyflies):
            struck = _strike(flight, fault)
        _see_through(flight, stall)
    with closing(Reader(flight.journal)) as reader:
        events = [event for _, event in reader.events()]
    kinds = ("mission.waits", "drone.waits", "drone.landed")
    told = [event for event in events if event["event"] in kinds]
    failed = [event for event in events if event["event"] == "trip.failed"]
    log = (gateway_folder(flight.journal) / "log").read_text(errors="replace")
    came = Came(
        told=len(told),
        trips=sum(event["event"] == "trip.launched" for event in events),
        failed=len(failed),
        lag=max(map(float, _STALLED.findall(log)), default=0.0),
    )
    came.wrong += [line for one in told if (line := str(line_of(one))) not in flight.told]
    old = stall * (1.0 if crtp else SPEED)  # what is known of a drone, at most
    slack = 2.0 + (1.0 if crtp else SPEED) * (2.0 if load else 0.5) + old
    came.wrong += _missions_unsaid(events, LONG + slack)
    came.wrong += _drones_unsaid(events, LONG + slack, LONG / 2 + old)
    for one in failed:
        why = fault.fails if crtp else _CHANCED
        is_struck = not crtp or one["drone"] in struck
        if not (is_struck and why and re.search(why, one["reason"])):
            came.wrong.append(f"nothing that befell {one['drone']} explains: {line_of(one)}")
    if came.wrong:
        came.wrong.append(str(folder))
    return came


def _strike(flight: Crazyflies, fault: Fault) -> Sequence[str]:
    """Let a fault befall the first in the air, and others if it is for more; return which."""
    flight.until(lambda: bool(_up(flight)), 120)
    first = _up(flight)
    drones = [*first, *(id for id in flight.state if id not in first)][: fault.drones]
    for drone in drones:
        flight.let(drone, fault.name, fault.value)
    if fault.seconds is not None:
        flight.goes_on(fault.seconds)
        for drone in drones:
            flight.let(drone, fault.name, not fault.value)
    return drones


def _up(flight: Crazyflies) -> Sequence[str]:
    """Return which drones are well in the air, the highest first."""
    with suppress(BadInput):  # they are not there yet
        heights = {id: float(drone["at"][2]) for id, drone in flight.state.items()}
        return [id for id in sorted(heights, key=heights.__getitem__)[::-1] if heights[id] > UP]
    return []


def _see_through(flight: Lives, stall: float) -> None:
    """Wait for the end; now and then the gateway is stopped for so many seconds."""
    patience = time.monotonic() + PATIENCE
    while stall and time.monotonic() < patience and flight.wait(BETWEEN_STALLS) is None:
        gateway = gateway_of(flight.journal)
        if gateway is not None:
            os.kill(gateway, signal.SIGSTOP)
            time.sleep(stall)
            os.kill(gateway, signal.SIGCONT)
    if flight.life is not None:
        flight.see_through(max(1.0, patience - time.monotonic()))


def _missions(dice: Random, count: int, trips: int) -> Iterator[str]:
    for n in range(count):
        yield f'[[mission]]\nname = "m{n}"'
        if n and dice.random() < 0.3:
            yield f'after = "m{dice.randrange(n)}"'
        elif dice.random() < 0.3:
            yield f'window = ["{dice.randint(15, 60)} s", "2 h"]'
        for _ in range(dice.randint(1, trips)):
            x, y = (round(dice.uniform(0.5, 8.5), 1) for _ in "xy")
            delay = f'delay = "{dice.randint(5, 40)} s"\n' if dice.random() < 0.3 else ""
            yield f'[[mission.trip]]\naction = "take_photo"\ntarget = [{x}, {y}]\n{delay}'


def _missions_unsaid(events: Sequence[Event], long: float) -> Iterator[str]:
    """Yield where a mission did not fly for so long, for one reason, without a word."""
    since: dict[str, float] = {}
    told: set[str] = set()
    for event in events:
        kind = event["event"]
        t = event["t"]
        name = str(event.get("mission", ""))
        if kind == "mission.waits":
            for one in [name] if name else event["missions"]:
                yield from _said("mission", one, since, told, t, long)
        elif kind in ("mission.promised", "mission.created", "trip.delayed", *_ENDS):
            yield from _silent("mission", name, since, told, t, long)
            since[name] = t
            if kind == "trip.delayed" and event["until"] - t < long:
                since[name] = event["until"]  # a short one, and then it may wait for a drone
        elif kind in ("trip.launched", "mission.ended"):
            yield from _silent("mission", name, since, told, t, long)


def _drones_unsaid(events: Sequence[Event], long: float, busy: float) -> Iterator[str]:
    """Yield where a drone was under way for so long without any command, and without a word, or with a wrong one."""
    since: dict[str, float] = {}
    told: set[str] = set()
    for event in events:
        kind = event["event"]
        t = event["t"]
        id = str(event.get("drone", ""))
        if kind == "drone.waits":
            yield from _said("drone", id, since, told, t, long)
            if event["for"] == "way" and _commanded(events, id, t - LONG, t) > busy:
                yield f"drone {id} was said to wait at {t:.1f} s, and carried out a command"
        elif kind == "drone.landed" and id in since:
            yield from _silent("drone", id, since, told, t, long)
            since[id] = t
        elif kind == "drone.flew" and id in since:
            yield from _silent("drone", id, since, told, t - event["seconds"], long)
            since[id] = t
        elif kind in _UNDER_WAY:
            since.setdefault(id, t)
        elif kind in _SETTLED:
            yield from _silent("drone", id, since, told, t, long)
    for id in list(since):
        yield from _silent("drone", id, since, told, events[-1]["t"], long)


def _commanded(events: Sequence[Event], id: str, begin: float, end: float) -> float:
    """Return for how many of these seconds a drone carried out commands."""
    flown = (one for one in events if one["event"] == "drone.flew" and one["drone"] == id)
    within = (min(end, one["t"]) - max(begin, one["t"] - one["seconds"]) for one in flown)
    return sum(seconds for seconds in within if seconds > 0)


def _said(
    what: str, who: str, since: dict[str, float], told: set[str], t: float, long: float
) -> Iterator[str]:
    """Note that a wait was told; yield it if that came late."""
    if who not in told and t - since.get(who, t) > long:
        yield f"{what} {who} waited from {since[who]:.1f} s, and it was said at {t:.1f} s only"
    told.add(who)


def _silent(
    what: str, who: str, since: dict[str, float], told: set[str], t: float, long: float
) -> Iterator[str]:
    began = since.pop(who, t)
    if t - began > long and who not in told:
        yield f"{what} {who} waited from {began:.1f} to {t:.1f} s, and nothing was said"
    told.discard(who)


if __name__ == "__main__":
    sys.exit(main())
