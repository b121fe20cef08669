"""Flies random plans by real processes, beside a load, and looks for waits of which nothing was said.

    python -m tests.waits --flights 6 --load 8
    python -m tests.waits --flights 2 --crtp

What waited is judged by the events of the journal alone: a mission between two flights, a drone that is under way and
commanded nothing. Each wait of more than ten seconds must have its line, in the journal and on the console.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, closing
from functools import partial
from pathlib import Path
from random import Random
from tempfile import mkdtemp
from typing import Any

from pluto_fleet.files.plan_waits import LONG
from pluto_fleet.journal.reader import Reader
from pluto_fleet.report.sentences import line_of
from tests.flights_crazyflie.flight import Flight as Crazyflies
from tests.kill.lives import Flight, Lives
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
FAULTS: Sequence[tuple[str, float | bool, Sequence[str]]] = (
    ("tumble", True, ("cf1", "cf2")),
    ("level", 0.3, ("cf1", "cf2", "cf3")),
    ("silent", True, ("cf1",)),
)
"""What befalls which Crazyflies once one was launched: a fault of each flight in turn."""
_BUSY = "while True: pass"
_ENDS = ("trip.completed", "trip.failed", "trip.interrupted")
_UNDER_WAY = ("trip.launched", "drone.returning", "drone.recovering", "drone.busy")
_SETTLED = ("drone.free", "drone.charging", "drone.lost", "drone.offline")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; 1 if a wait was not told."""
    campaign = Campaign("tests.waits", __doc__)
    campaign.draws("flights", 6)
    campaign.option("--load", type=int, default=0, metavar="N", help="busy loops beside them")
    campaign.option("--crtp", action="store_true", help="with Crazyflies, simulated to their radio")
    options = campaign.parse(arguments)
    waits = 0
    one = partial(fly, load=options.load, crtp=options.crtp)
    for number, (told, wrong) in campaign.each(one, campaign.numbers):
        waits += told
        if wrong:
            campaign.found(f"flight {number}", *wrong)
    return campaign.over(f"{waits} waits and landings were told")


def fly(number: int, *, load: int, crtp: bool) -> tuple[int, list[str]]:
    """Fly a plan to its end; return how much was told, and what was not, or is wrong."""
    folder = Path(mkdtemp(prefix=f"waits{number}_"))
    (folder / "app.pluto").write_text(APP)
    source = compiled_file(folder / "app.pluto", folder / "package") / "src"
    dice = Random(f"waits/{number}")
    (folder / "missions.toml").write_text("\n".join(_missions(dice)))
    homes = [f'[[drone]]\nid = "cf{n}"\nhome = [{n}, 0.5]' for n in range(1, CRAZYFLIES + 1)]
    (folder / "fleet.toml").write_text("\n".join(["[map]\nsize = [9, 9]", *homes]))
    flight: Lives
    if crtp:
        flight = Crazyflies(app="waiting", source=source, folder=folder, drones=CRAZYFLIES)
    else:
        chance = ["--fail", "crash=10%,link=10%", "--seed", str(number)]
        flight = Flight(app="waiting", source=source, folder=folder, speed=SPEED, chance=chance)
    with ExitStack() as stack:
        for _ in range(load):
            busy = stack.enter_context(subprocess.Popen([sys.executable, "-c", _BUSY]))
            stack.callback(busy.kill)
        stack.callback(flight.end)
        flight.start()
        if isinstance(flight, Crazyflies):
            flight.until(lambda: "launched" in flight.told)
            fault, value, drones = FAULTS[number % len(FAULTS)]
            for drone in drones:
                flight.let(drone, fault, value)
        flight.see_through(PATIENCE)
    with closing(Reader(flight.journal)) as reader:
        events = [event for row in reader.rows() for event in json.loads(row.text)]
    kinds = ("mission.waits", "drone.waits", "drone.landed")
    told = [event for event in events if event["event"] in kinds]
    wrong = [line for one in told if (line := str(line_of(one))) not in flight.told]
    slack = 2.0 + (1.0 if crtp else SPEED) * (2.0 if load else 0.5)
    wrong += [*_missions_unsaid(events, LONG + slack), *_drones_unsaid(events, LONG + slack)]
    return len(told), [*wrong, str(folder)] if wrong else []


def _missions(dice: Random) -> Iterator[str]:
    for n in range(6):
        yield f'[[mission]]\nname = "m{n}"'
        if n and dice.random() < 0.3:
            yield f'after = "m{dice.randrange(n)}"'
        elif dice.random() < 0.3:
            yield f'window = ["{dice.randint(15, 60)} s", "2 h"]'
        for _ in range(dice.randint(1, 3)):
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
            told.update([name] if name else event["missions"])
        elif kind in ("mission.promised", "mission.created", "trip.delayed", *_ENDS):
            yield from _silent("mission", name, since, told, t, long)
            since[name] = t
            if kind == "trip.delayed" and event["until"] - t < long:
                since[name] = event["until"]  # a short one, and then it may wait for a drone
        elif kind in ("trip.launched", "mission.ended"):
            yield from _silent("mission", name, since, told, t, long)


def _drones_unsaid(events: Sequence[Event], long: float) -> Iterator[str]:
    """Yield where a drone was under way for so long without any command, and without a word."""
    since: dict[str, float] = {}
    told: set[str] = set()
    for event in events:
        kind = event["event"]
        t = event["t"]
        id = str(event.get("drone", ""))
        if kind in ("drone.waits", "drone.landed"):
            told.add(id)
        elif kind == "drone.flew" and id in since:
            yield from _silent("drone", id, since, told, t - event["seconds"], long)
            since[id] = t
        elif kind in _UNDER_WAY:
            since.setdefault(id, t)
        elif kind in _SETTLED:
            yield from _silent("drone", id, since, told, t, long)


def _silent(
    what: str, who: str, since: dict[str, float], told: set[str], t: float, long: float
) -> Iterator[str]:
    began = since.pop(who, t)
    if t - began > long and who not in told:
        yield f"{what} {who} waited from {began:.1f} to {t:.1f} s, and nothing was said"
    told.discard(who)


if __name__ == "__main__":
    sys.exit(main())
