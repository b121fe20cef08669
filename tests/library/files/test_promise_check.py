"""What `check` calls impossible no order of flights can do: small plans are searched exhaustively."""

from __future__ import annotations

from dataclasses import dataclass, replace
from random import Random
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.files.plan_check import impossible
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.model import AfterTrip, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from pluto_fleet.shared.fleet.reach import chain_of, flight_seconds, stops_of
from pluto_fleet.shared.time.hours import Hours
from tests.kit import apps

APP = moving(apps.app(apps.flow()), CRAZYFLIE.exact)
(SCOUT,) = APP.categories


@dataclass(frozen=True, slots=True)
class Stand:
    """How far a schedule has come."""

    drones: tuple[tuple[float, Point], ...]
    """When each can fly again, and where it stands."""
    missions: tuple[tuple[int, float], ...]
    """How many flights each has had, and when the last one was done."""


def can_be_kept(app: App, fleet: FleetFile, missions: list[apps.Mission], stand: Stand) -> bool:
    """Return whether some order of flights from here on keeps every promise: try all of them."""
    flights = [chains(one) for one in missions]
    left = [n for n, (flown, _) in enumerate(stand.missions) if flown < len(flights[n])]
    if not left:
        return True
    ends = {one.name: stand.missions[n][1] for n, one in enumerate(missions) if n not in left}
    space = fleet.airspace
    for n in left:
        promises = missions[n].promises
        if not ends.keys() >= {*promises.get("after", ())}:
            continue
        flown, ready = stand.missions[n]
        ready = max(
            ready, promises.get("opens", 0.0), *(ends[a] for a in promises.get("after", ())), 0.0
        )
        chain = flights[n][flown]
        stops = stops_of(app, SCOUT, space.cruise_height, chain)
        points, busy = [point for point, _ in stops], sum(seconds for _, seconds in stops)
        for d, (free, place) in enumerate(stand.drones):
            done = max(free, ready) + flight_seconds(SCOUT, space, place, points, busy)
            if done > promises.get("deadline", 1e9) + 1e-6:
                continue
            home = fleet.drones[d].home if fleet.after_trip is AfterTrip.HOME else points[-1]
            down = (home[0], home[1], 0.0)
            again = done + flight_seconds(SCOUT, space, points[-1], [down], 0.0)
            if fleet.after_trip is AfterTrip.ONWARD:
                down = points[-1]
                again = done
            drones = (*stand.drones[:d], (again, down), *stand.drones[d + 1 :])
            told = (*stand.missions[:n], (flown + 1, done), *stand.missions[n + 1 :])
            if can_be_kept(app, fleet, missions, Stand(drones, told)):
                return True
    return False


def chains(mission: apps.Mission) -> list[Any]:
    found, rest = [], list(mission.trips)
    while rest:
        found.append(chain_of(rest))
        rest = rest[len(found[-1]) :]
    return found


def drawn(seed: int) -> tuple[FleetFile, list[apps.Mission]]:
    """Return a small fleet and plan, with promises that are near to what can be kept."""
    rng = Random(seed)
    homes = rng.sample([(1.0, 1.0, 0.0), (9.0, 1.0, 0.0), (18.0, 12.0, 0.0)], rng.choice((1, 2)))
    after = rng.choice((AfterTrip.HOME, AfterTrip.STAY, AfterTrip.ONWARD))
    missions: list[apps.Mission] = []
    for number in range(rng.choice((1, 2, 3))):
        spots = [rng.uniform(1.0, 19.0) for _ in range(rng.choice((1, 1, 2)))]
        trips = [apps.trip(f"{n}", x, rng.uniform(1, 15)) for n, x in enumerate(spots)]
        if rng.random() < 0.2:
            trips = [apps.pick("p", spots[0]), apps.release("r", rng.uniform(1.0, 19.0))]
        promises: dict[str, Any] = {}
        if rng.random() < 0.7:
            promises["deadline"] = rng.uniform(10.0, 120.0)
        if rng.random() < 0.3:
            promises["opens"] = rng.uniform(0.0, 40.0)
        if missions and rng.random() < 0.4:
            promises["after"] = [rng.choice(missions).name]
        missions.append(apps.mission(f"m{number}", *trips, index=number, promises=promises))
    return replace(apps.fleet(*homes, after=after), motion=CRAZYFLIE.exact), missions


@pytest.mark.parametrize("first", range(0, 400, 50))
def test_what_is_called_impossible_no_order_can_do(first: int) -> None:
    told = kept = 0
    for seed in range(first, first + 50):
        fleet, missions = drawn(seed)
        begin = Stand(
            tuple((0.0, one.home) for one in fleet.drones), tuple((0, 0.0) for _ in missions)
        )
        possible = can_be_kept(APP, fleet, missions, begin)
        said = impossible(missions, APP, fleet)
        assert not (said and possible), (seed, said)
        told += bool(said)
        kept += possible
    assert told > 5 and kept > 5


def one(**promises: Any) -> list[str]:
    """Return what is told of a mission of some thirty seconds with these promises."""
    before = apps.mission("a", apps.trip("1", 6.0))
    mission = apps.mission("b", apps.trip("1", 6.0), index=1, promises=promises)
    return impossible([before, mission], APP, replace(apps.fleet(), motion=CRAZYFLIE.exact))


def test_each_reason_is_told() -> None:
    assert one(deadline=1000.0) == one(after=["a"]) == one() == []
    assert one(deadline=5.0) == ['mission "b": it is due after 5 s, and takes 32.6 s at the least']
    short = ['mission "b": its window lasts 10 s, and it takes 32.6 s at the least']
    assert one(opens=60.0, deadline=70.0) == one(opens="08:00", deadline="08:00:10") == short
    assert one(opens="23:59:50", deadline="00:05") == one(opens=1800.0, deadline="00:10") == []
    (after,) = one(after=["a"], deadline=40.0)
    assert after == (
        'mission "b": it comes after "a", which ends after 32.6 s at the soonest; it takes 32.6 s more'
        " at the least, and is due after 40 s"
    )


def test_what_comes_after_an_endless_mission_never_begins() -> None:
    before = apps.mission("a", apps.trip("1", 6.0), repeat=True)
    mission = apps.mission("b", apps.trip("1", 6.0), index=1, promises={"after": ["a"]})
    assert impossible([before, mission], APP, apps.fleet()) == [
        'mission "b": it comes after "a", which repeats until it is stopped, and never completes'
    ]


def test_times_of_day_are_known_where_the_start_is() -> None:
    late, soon = {"deadline": "08:30"}, {"opens": "08:00", "deadline": "08:30"}
    fleet = replace(apps.fleet(), motion=CRAZYFLIE.exact)
    mission = apps.mission("a", apps.trip("1", 6.0), promises=late)
    assert (
        impossible([mission], APP, fleet)
        == impossible([mission], APP, fleet, Hours(30_000.0))
        == []
    )
    said = "it is due after 10 s, and takes 32.6 s at the least"
    assert impossible([mission], APP, fleet, Hours(30_590.0)) == [f'mission "a": {said}']
    mission.promises = soon
    assert impossible([mission], APP, fleet, Hours(29_000.0)) == []
    assert impossible([mission], APP, fleet, Hours(30_590.0)) == [f'mission "a": {said}']


def test_a_window_that_mixes_both_kinds_of_time_may_close_before_it_opens() -> None:
    mission = apps.mission(
        "a", apps.trip("1", 6.0), promises={"opens": 1800.0, "deadline": "00:10"}
    )
    told = impossible([mission], APP, apps.fleet(), Hours(85_800.0))  # at 23:50
    assert told == ['mission "a": it is due 10 min before its window opens']
    assert impossible([mission], APP, apps.fleet(), Hours(80_000.0)) == []


def test_too_few_drones_are_told_once() -> None:
    missions = [
        apps.mission(f"{n}", apps.trip("1", 6.0), index=n, promises={"deadline": 90.0 + n})
        for n in range(4)
    ]
    (said,) = impossible(missions, APP, replace(apps.fleet(), motion=CRAZYFLIE.exact))
    assert "2 missions due after 1 min 31 s or sooner take" in said
    assert "and 1 drone can fly for 1 min 31 s until then" in said
