"""Ten Crazyflies in the air at once, crossing each other's ways home: Stop brings all of them down."""

from __future__ import annotations

import time
from collections.abc import Sequence
from math import dist

import pytest

from plutoc_runtime.asking import ask, note_of
from plutoc_runtime.crazyflie.courses import SHORTEST, seconds_for
from plutoc_runtime.crtp.record import Deed, Point
from plutoc_runtime.drones.member import CLIMB_LIMIT
from plutoc_runtime.journal.values import point_of
from tests.flights_crazyflie.conftest import NewFlight
from tests.flights_crazyflie.flight import Flight
from tests.flights_crazyflie.judge import dropped, left_in_the_air, nearest
from tests.flights_crazyflie.plans import Plan, fleet, homes, missions, targets

TEN = 10
APART = 0.5
SPEED = 0.5
"""Metres per second: what the app's drones may fly at most."""
LATER = 2.0
"""Seconds that the last may be down after the slowest would be alone."""
HOVERS = "[navigation.crazyflie]\nmeasure_seconds = 100\n"


def crossing() -> Plan:
    """Return a mission a drone: each measures before the home of its neighbour."""
    places = list(homes(TEN).values())
    aims = [places[row * 5 + (column + 1) % 5] for row in range(2) for column in range(5)]
    return {
        (f"M{number}", "t"): ("measure", (x, y + 1.2), "")
        for number, (x, y, _) in enumerate(aims, 1)
    }


AIMS = list(targets(crossing()).values())


def alone(where: Point, home: Point | None) -> float:
    """Return the seconds that a drone takes to come down with nobody else in the air."""
    x, y, z = where
    way = 0.0 if home is None else seconds_for(dist((x, y), home[:2]), SPEED)
    return SHORTEST + way + seconds_for(z, CLIMB_LIMIT)


def touchdowns(deeds: Sequence[Deed], since: float) -> dict[str, float]:
    """Return when each drone was down, in seconds since then."""
    return {deed.drone: deed.time - since for deed in deeds if deed.what == "down"}


@pytest.mark.parametrize("how", ["land", "rtl"])
def test_all_are_down_soon_after_the_slowest_alone_and_never_too_near(
    how: str, new_flight: NewFlight, capsys: pytest.CaptureFixture[str]
) -> None:
    flight = new_flight(missions(crossing()), fleet(TEN) + HOVERS, TEN)
    flight.start()
    flight.until(lambda: all_there(flight), 120.0)
    places = {id: point_of(one["at"]) for id, one in flight.state.items()}
    began = time.monotonic()
    ask(note_of(flight.journal), {"command": "stop", "how": how}, 90.0)
    assert flight.wait() == 130, flight.told
    deeds, trace = flight.deeds, flight.trace
    assert [*dropped(deeds), *left_in_the_air(deeds)] == []
    down = touchdowns(deeds, began)
    assert set(down) == set(homes(TEN))
    slowest = max(
        alone(places[id], home if how == "rtl" else None) for id, home in homes(TEN).items()
    )
    least, who = nearest(trace)
    with capsys.disabled():
        last = max(down.values())
        print(f"\n{how}: ten down in {last:.1f} s, the slowest alone {slowest:.1f} s,", end=" ")
        print(f"never nearer than {least:.2f} m")
    assert least > APART, who
    assert max(down.values()) < slowest + LATER
    if how == "rtl":
        for id, home in homes(TEN).items():
            assert dist(flight.state[id]["at"][:2], home[:2]) < 0.2, id


def all_there(flight: Flight) -> bool:
    """Whether all hover where they measure."""
    if len(flight.airborne()) < TEN:
        return False
    places = [point_of(one["at"]) for one in flight.state.values()]
    return all(any(dist(place, there) < 0.15 for place in places) for there in AIMS)
