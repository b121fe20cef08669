"""What must hold of a flight with Crazyflies, by the drones' own record."""

from __future__ import annotations

import re
import time
from bisect import bisect_left, bisect_right
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from math import dist, inf

from pluto_fleet.crtp.flight_log import CommandRecord, Point, PositionRecord
from pluto_fleet.jobs.flown import ACTS_BESIDE
from tests.flights_crazyflie.flight import Event, Flight

NEAR = 0.1
"""Metres that a drone may be beside its target while it does what it came for."""
APART = 0.5
"""Metres that drones are kept apart in the air, where a fleet file says nothing else."""
FURTHEST = 1.5
"""Metres from its target that an action may be done, where another drone has its place."""
_STILL = (0.35, 0.1)
"""Seconds before an action's end was written down, between which its drone was still there."""
_STALL = 1.0
"""Seconds for which a busy machine may keep the drones from writing down where they are."""
_SLOT = 0.02
"""Seconds: drones are held against each other where they were within one slot."""
_HIGH = 4.0
"""Metres above which no plan of these flights leads."""
_OFF_GROUND = 0.1
"""Metres above which a drone counts as being in the air."""

_WALL = time.time() - time.monotonic()
"""What makes a time on the wall of one that only goes on."""


def beside_its_target(
    events: Sequence[Event],
    trace: Sequence[PositionRecord],
    targets: Mapping[tuple[str, str], Point],
) -> Iterator[str]:
    """Yield the trips that were completed where their target was not, or where it was said that they are done."""
    said: dict[tuple[str, str], Point] = {}
    by_drone: dict[str, list[PositionRecord]] = defaultdict(list)
    for place in trace:
        by_drone[place.drone].append(place)
    for event in events:
        if event["event"] == ACTS_BESIDE:
            said[event["mission"], event["trip"]] = event["at"]
        if event["event"] != "trip.completed":
            continue
        which = event["mission"], event["trip"]
        whose = f"{event['mission']}/{event['trip']}"
        target = said.pop(which, targets[which])
        if dist(target, targets[which]) > FURTHEST:
            yield f"{whose}: was done {dist(target, targets[which]):.2f} m away"
        ended = event["wall"] - _WALL
        places = by_drone[event["drone"]]
        first = bisect_left(places, ended - _STILL[0], key=lambda one: one.time)
        last = bisect_right(places, ended - _STILL[1], key=lambda one: one.time)
        if first == last:  # nothing was written down then: where was it just before?
            first = max(0, first - 1)
        if first == last or places[first].time < ended - _STALL:
            yield f"{whose}: {event['drone']} was not in the air"
        off = max((dist(place.at, target) for place in places[first:last]), default=0.0)
        if off > NEAR:
            yield f"{whose}: {event['drone']} was {off:.2f} m off"


def dropped(commands: Sequence[CommandRecord]) -> Iterator[str]:
    """Yield what has cut motors in the air: a link that closed, an emergency stop, a fall."""
    cutting = ("setpoint", "emergency stop", "stop", "switched off", "collision")
    for command in commands:
        if command.what in cutting and command.flying:
            yield f"{command.drone}: {command.what} in the air at {command.at}"


def left_in_the_air(commands: Sequence[CommandRecord]) -> Iterator[str]:
    """Yield the drones that have taken off, and did not come down again."""
    last: dict[str, str] = {}
    for command in commands:
        if command.what in ("takeoff", "go_to") and not command.values.get("answer"):
            last[command.drone] = "up"
        elif command.what in ("down", "switched off"):
            last[command.drone] = "down"
    yield from (f"{drone} is still in the air" for drone, what in last.items() if what == "up")


def astray(commands: Sequence[CommandRecord], size: tuple[float, float]) -> Iterator[str]:
    """Yield the commands to fly where no drone is wanted: far outside of the floor, or high up."""
    for command in commands:
        if command.what == "go_to":
            x, y, z = (command.values[axis] for axis in "xyz")
            if not (-1.0 < x < size[0] + 1.0 and -1.0 < y < size[1] + 1.0 and 0.0 < z < _HIGH):
                yield f"{command.drone} was told to fly to ({x:.1f}, {y:.1f}, {z:.1f})"


def unmeant(
    commands: Sequence[CommandRecord],
    trace: Sequence[PositionRecord],
    size: tuple[float, float],
    falls: tuple[str, ...] = (),
) -> Iterator[str]:
    """Yield what no flight may do; `falls`: the drones that may come down otherwise than by landing."""
    down = (*dropped(commands), *left_in_the_air(commands))
    yield from (one for one in down if not one.startswith(falls))
    yield from astray(commands, size)
    least, who = nearest(trace)
    if least < APART:
        yield f"{least:.2f} m apart: {who}"


def not_as_meant(flight: Flight, fails: str) -> Iterator[str]:
    """Note why trips have failed; yield what is wrong with that: none may, or one must with this reason."""
    reasons = [event["reason"] for event in flight.events if event["event"] == "trip.failed"]
    flight.notes.extend(dict.fromkeys(reasons))
    if fails and not any(re.search(fails, reason) for reason in reasons):
        yield f"no trip has failed with {fails!r}"
    if not fails and reasons:
        yield "a trip has failed"


def badly_ended(flight: Flight, code: int, meant: int = 0) -> Iterator[str]:
    """Yield what no flight may end with: another exit code, a mission that is not completed, a traceback."""
    if code != meant:
        yield f"exit code {code}"
    for mission, status in flight.ends().items():
        if status != "COMPLETED":
            yield f"{mission} ended as {status}"
    if "Traceback" in flight.told:
        yield "a traceback was printed"


def nearest(trace: Sequence[PositionRecord]) -> tuple[float, str]:
    """Return how near two drones in the air have come to each other, and which and when."""
    slots: dict[int, dict[str, PositionRecord]] = defaultdict(dict)
    for place in trace:
        if place.at[2] > _OFF_GROUND:
            slots[round(place.time / _SLOT)][place.drone] = place
    least, who = inf, ""
    for places in slots.values():
        for one, other in combinations(places.values(), 2):
            apart = dist(one.at, other.at)
            if apart < least:
                least, who = apart, f"{one.drone} at {one.at}, {other.drone} at {other.at}"
    return least, who
