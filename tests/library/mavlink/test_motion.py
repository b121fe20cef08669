"""How simulated autopilots fly their legs: by their makes' own laws, step by step, and as the motion model counts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import dist, hypot, inf, radians

import pytest

from pluto_fleet.autopilot.ardupilot import ArduPilot
from pluto_fleet.autopilot.px4 import Px4
from pluto_fleet.autopilot.vehicle import Build, Doing, Vehicle
from pluto_fleet.shared.domain.motion import STEADY, Motion
from pluto_fleet.wind import CALM, Wind, effort

TICK = 0.02
REACH, STILL, RESTS = 0.5, 0.3, 0.5
"""When a leg counts as flown, as for real vehicles."""
MAKES = (Px4, ArduPilot)
MOTIONS = {Px4: STEADY, ArduPilot: replace(STEADY, acceleration=2.5, jerk=5.0, settles=0.85)}
"""By their parameters, with what braking takes in their own ways besides."""
EAST = (1.0, 0.0)


def hovering(make: type[Vehicle], wind: Wind = CALM) -> Vehicle:
    build = Build(id="m1", system=1, home=(47.4, 8.5, 400.0), wind=wind)
    vehicle = make(build)  # type: ignore[call-arg]
    vehicle.body.at[2] = 20.0
    vehicle.armed = vehicle.has_flown = True
    vehicle.doing = Doing.GO
    return vehicle


def flying(
    vehicle: Vehicle, metres: float, speed: float, along: tuple[float, float] = EAST
) -> Iterator[float]:
    """Fly a leg until it counts as flown; yield the time at each step."""
    body = vehicle.body
    body.goal = (metres * along[0], metres * along[1], 20.0)
    body.limits.level = speed
    if isinstance(vehicle, ArduPilot):
        vehicle._speed = speed
    time = 0.0
    rests_since = inf
    while time - rests_since < RESTS:
        assert time < 200.0
        vehicle.step(TICK)
        time += TICK
        is_there = dist(body.at, body.goal) < REACH and body.speed < STILL
        rests_since = min(rests_since, time) if is_there else inf
        yield time


@pytest.mark.parametrize("make", MAKES)
@pytest.mark.parametrize("speed", [2.0, 5.0, 10.0])
@pytest.mark.parametrize("metres", [0.3, 2.0, 7.0, 25.0, 90.0])
def test_no_limit_is_exceeded(make: type[Vehicle], speed: float, metres: float) -> None:
    """Neither the speed, nor the acceleration, nor the jerk; and it does not shoot far over its goal."""
    vehicle = hovering(make)
    limits = vehicle.body.limits
    before = (0.0, 0.0)
    fastest = hardest = roughest = furthest = 0.0
    for _ in flying(vehicle, metres, speed):
        velocity = vehicle.body.velocity[0]
        push = (velocity - before[0]) / TICK
        fastest = max(fastest, abs(velocity))
        hardest = max(hardest, abs(push))
        roughest = max(roughest, abs(push - before[1]) / TICK)
        furthest = max(furthest, vehicle.body.at[0])
        before = (velocity, push)
    assert fastest <= speed * 1.01
    assert hardest <= limits.level_acceleration + 1e-6
    assert roughest <= limits.jerk + 1e-6
    assert furthest <= metres + 0.3


@pytest.mark.parametrize("make", MAKES)
@pytest.mark.parametrize("speed", [3.0, 5.0, 8.0])
@pytest.mark.parametrize("metres", [25.0, 50.0, 100.0, 200.0])
def test_a_leg_takes_what_is_counted_with(make: type[Vehicle], speed: float, metres: float) -> None:
    """The one is integrated by the laws of the makes, the other is an S-curve in closed form."""
    *_, seconds = flying(hovering(make), metres, speed)
    assert seconds == pytest.approx(MOTIONS[make].flies(metres, speed), rel=0.05, abs=0.9)


@pytest.mark.parametrize("make", MAKES)
@pytest.mark.parametrize("metres", [0.0, 20.0])
def test_a_leg_that_leads_down_takes_what_a_descent_takes(
    make: type[Vehicle], metres: float
) -> None:
    """It sinks more slowly than it flies."""
    vehicle = hovering(make)
    vehicle.body.at[2] = 35.0
    *_, seconds = flying(vehicle, metres, 5.0)
    motion = MOTIONS[make]
    ((_, _, on, after),) = motion.stages([(0.0, 0.0, 35.0), (metres, 0.0, 20.0)], 5.0, False, False)
    assert seconds == pytest.approx(on + after, rel=0.05, abs=0.9)


@pytest.mark.parametrize("along", [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.6, 0.8)])
@pytest.mark.parametrize("speed", [4.0, 8.0, 11.0])
def test_a_leg_in_the_wind_takes_what_is_counted_with(
    speed: float, along: tuple[float, float]
) -> None:
    """Slower upwind, where its airspeed does not suffice; with the wind no faster."""
    wind = Wind(speed=speed, origin=radians(90.0))
    motion = in_wind(wind)
    there = (100.0 * along[0], 100.0 * along[1], 0.0)
    over_ground = motion.against((0.0, 0.0, 0.0), there, 8.0)
    *_, seconds = flying(hovering(Px4, wind), 100.0, 8.0, along)
    assert seconds == pytest.approx(motion.flies(100.0, over_ground), rel=0.06)


def in_wind(wind: Wind) -> Motion:
    return replace(STEADY, wind=wind.on_map(0.0))


@pytest.mark.parametrize("speed", [0.0, 5.0, 9.0, 12.0])
def test_there_and_back_takes_no_more_of_a_battery_than_is_counted_with(speed: float) -> None:
    """All ways around, and not much less either; in calm air just that."""
    wind = Wind(speed=speed, origin=radians(90.0))
    vehicle = hovering(Px4, wind)
    seconds = 0.0
    for along in ((1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)):
        *_, took = flying(vehicle, 60.0, 6.0, along)
        seconds += took
    used = (1.0 - vehicle.charge) * vehicle.build.flight / seconds
    expected = effort(in_wind(wind), 6.0)
    assert used == pytest.approx(expected, rel=0.12)
    assert speed or used == pytest.approx(1.0)


@pytest.mark.parametrize("make", MAKES)
def test_wind_beyond_its_airspeed_blows_it_away(make: type[Vehicle]) -> None:
    """As fast as that is stronger; below, it holds its place."""
    most = hovering(make).body.limits.airspeed
    for wind, drift in ((most - 1.0, 0.0), (most + 2.0, 2.0)):
        vehicle = hovering(make, Wind(speed=wind, origin=radians(270.0)))
        vehicle.body.goal = (0.0, 0.0, 20.0)
        for _ in range(1000):
            vehicle.step(TICK)
        assert hypot(*vehicle.body.velocity) == pytest.approx(drift, abs=0.05)


def test_gusts_are_those_of_their_seed_and_no_stronger_than_is_said() -> None:
    wind = Wind(speed=5.0, origin=0.0, gusts=3.0, seed=7)
    blows = [hypot(*wind.at(float(second))) for second in range(2000)]
    assert max(blows) <= 8.0
    assert max(blows) - min(blows) > 3.0
    assert sum(blows) / len(blows) == pytest.approx(5.0, abs=0.1)
    assert wind.at(11.0) == replace(wind).at(11.0) != replace(wind, seed=8).at(11.0)
