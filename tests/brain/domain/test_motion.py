"""The motion model: what legs and charges take, and that simulated drones take just that."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, dist, hypot, sin, sqrt
from statistics import fmean, pstdev

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from pluto_fleet.shared.alone.drones import IdealDrones
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.actions import BUILT_IN, MEASURE
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fleet_data import DroneData, FleetData
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.domain.motion import (
    CRAZYFLIE,
    MOST,
    SHORTEST,
    STEADY,
    STRAIGHT,
    Motion,
    charged,
    charging,
    smoothly,
    varied,
    varies,
)
from pluto_fleet.shared.fleet.reach import flight_seconds
from tests.library.files.an_app import APP

STEPS = 400
TIGHT = 0.995
"""The least share of one of its bounds that each leg reaches: none is slower than it must be."""

speeds = st.floats(0.05, 5.0)
overheads = st.floats(0.0, 5.0)
smooth = st.builds(
    Motion,
    legs=st.just("smooth"),
    limit=st.floats(0.05, 5.0),
    take_off=overheads,
    settles=overheads,
    landing=overheads,
    pace=st.floats(0.5, 2.0),
)
motions = st.sampled_from([STRAIGHT, CRAZYFLIE.exact]) | smooth

# Legs


def fastest(metres: float, seconds: float) -> tuple[float, float]:
    """Return the peak speed and the peak acceleration of a smooth leg, by small differences."""
    step = 1 / STEPS
    at = [metres * smoothly(n * step) for n in range(STEPS + 1)]
    speed = [(b - a) / step / seconds for a, b in pairwise(at)]
    acceleration = [abs(b - a) / step / seconds for a, b in pairwise(speed)]
    return max(speed), max(acceleration)


@given(smooth, st.floats(0.01, 200.0), speeds)
def test_a_smooth_leg_is_as_quick_as_its_bounds_allow(
    motion: Motion, metres: float, speed: float
) -> None:
    """Its peak speed, its acceleration, and the shortest duration; one of them it reaches."""
    seconds = replace(motion, pace=1.0).leg(metres, speed)
    peak, push = fastest(metres, seconds)
    limit = min(speed, motion.limit)
    assert peak <= limit + 1e-9
    assert push <= MOST + 1e-6
    assert seconds >= SHORTEST
    assert peak >= TIGHT * limit or push >= TIGHT * MOST or seconds == SHORTEST
    assert motion.leg(metres, speed) == pytest.approx(motion.pace * seconds)


# Charges

levels = st.floats(0.0, 1.0)
fulls = st.floats(1.0, 1e5)
tapers = st.just(0.0) | st.floats(0.01, 0.5)


@given(levels, levels, fulls, tapers)
@example(0.0, 1.0, 1200.0, 0.0)
@example(0.0, 1.0, 1200.0, 0.2)
def test_a_battery_is_as_full_as_was_promised(
    one: float, other: float, full: float, taper: float
) -> None:
    """Charging for as long as it takes to a level ends there."""
    level, target = sorted((one, other))
    seconds = charging(level, target, full, taper)
    assert 0.0 <= seconds <= full * (1 + 1e-9)
    assert charged(level, seconds, full, taper) == pytest.approx(target, abs=1e-6)


@given(fulls, tapers)
def test_a_charge_from_empty_to_full_takes_its_time(full: float, taper: float) -> None:
    """Even until its taper, at the fastest rate; from there on without a jump, ever more slowly."""
    assert charging(0.0, 1.0, full, taper) == pytest.approx(full)
    assert charged(0.0, full, full, taper) == pytest.approx(1.0)
    slows = charging(0.0, 1 - taper, full, taper)
    assert slows == pytest.approx(full * (1 - taper) / (1 + taper))
    at = [charged(0.0, full * n / STEPS, full, taper) for n in range(STEPS + 1)]
    gained = [b - a for a, b in pairwise(at)]
    assert max(gained) <= (1 + taper) / STEPS + 1e-9
    assert all(b <= a + 1e-9 for a, b in pairwise(gained))
    even = gained[: int(STEPS * slows / full)]
    assert even == pytest.approx([(1 + taper) / STEPS] * len(even))


# Flights

coordinate = st.floats(0.0, 20.0).map(lambda value: round(value, 2))
stops = st.lists(
    st.tuples(coordinate, coordinate, st.floats(0.2, 3.0)), min_size=1, max_size=4
) | st.just([(1.0, 1.0, 1.2)])
WALL = Airspace(no_fly=(((8, 2), (9, 2), (9, 18), (8, 18)),))
HOME = (1.0, 1.0, 0.0)


def kind(motion: Motion, speed: float = 0.5) -> Category:
    """Return a category whose drones move so, and whose batteries last."""
    return Category(name="tireless", speed=speed, flight_time=1e6, charge_time=1.0, motion=motion)


@dataclass
class Hand:
    """A clock that is moved by hand."""

    now: float = 0.0


class Ideal:
    """One drone of a package alone, by its orders."""

    def __init__(self, category: Category, seed: int = 1) -> None:
        drone = DroneData(id="cf1", category=category.name, home=HOME)
        fleet = FleetData(airspace=WALL, drones=[drone], motion=category.motion)
        self.clock = Hand()
        app = replace(APP, categories=(category,))
        self.drones = IdealDrones(app, fleet, Faults(), seed, self.clock)
        self.orders = 0

    def does(self, what: str, **order: object) -> float:
        """Let it do something, and return how long that took."""
        begun, self.orders = self.clock.now, self.orders + 1
        self.drones.obey({"id": self.orders, "drone": "cf1", "do": what, **order})
        told: dict[str, object] = {}
        while not told:
            self.clock.now = max(self.clock.now, self.drones.due)
            told = self.drones.advance()
        assert told.get("done") == self.orders, told
        return self.clock.now - begun

    def flies(self, *stops: Point, action: str | None = None, flight: str = "a") -> float:
        """Let it fly to all stops."""
        given = {"seconds": 0.0, "flight": flight, "item": None, "parameters": {}}
        return self.does("fly", stops=stops, action=action, **given)


@given(motions, speeds, stops)
def test_a_flight_takes_exactly_what_was_expected(
    motion: Motion, speed: float, points: list[Point]
) -> None:
    """There and back home, by a package alone and through the gateway."""
    assume(not any(map(WALL.problem, points)))
    category = kind(motion, speed)
    there = flight_seconds(category, WALL, HOME, points, 0.0)
    back = flight_seconds(category, WALL, points[-1], [HOME], 0.0)
    alone = Ideal(category)
    assert (alone.flies(*points), alone.does("home")) == pytest.approx((there, back))


def test_a_flight_home_takes_off_first() -> None:
    """Where a drone has landed elsewhere; in its dock it lands where it rose."""
    drone, category = Ideal(kind(CRAZYFLIE.exact)), kind(CRAZYFLIE.exact)
    away = (4.0, 5.0, 1.2)
    drone.flies(away)
    assert drone.does("land") == pytest.approx(category.motion.lands(1.2, category.speed))
    expected = flight_seconds(category, WALL, (4.0, 5.0, 0.0), [HOME], 0.0)
    assert drone.does("home") == pytest.approx(expected)


# Spread

NEAR, FAR = (1.0, 1.0, 1.2), (5.0, 1.0, 1.2)
SPREAD = 0.1
MEASURES = BUILT_IN[MEASURE].seconds


def to_and_fro(motion: Motion, seed: int = 1, count: int = 3000) -> list[float]:
    """Return how long a drone takes to fly there and measure, again and again."""
    drone = Ideal(kind(motion), seed)
    drone.flies(NEAR)
    return [
        drone.flies((FAR, NEAR)[number % 2], action=MEASURE, flight=str(number))
        for number in range(count)
    ]


def assert_spread(factors: Sequence[float]) -> None:
    """Around what is expected, never more than three standard deviations away."""
    assert fmean(factors) == pytest.approx(1.0, abs=SPREAD * 4 / sqrt(len(factors)))
    assert pstdev(factors) == pytest.approx(SPREAD, rel=0.05)
    assert max(abs(factor - 1.0) for factor in factors) <= 3 * SPREAD + 1e-9


@pytest.mark.parametrize(
    ("flown", "seconds"),
    [
        (STEADY.rises(15.0, 4.0), 13.5),
        (STEADY.flies(109.0, 4.0), 31.6),
        (STEADY.flies(39.5, 4.0), 14.2),
        (STEADY.flies(12.3, 4.0), 7.3),
        (STEADY.lands(18.0, 4.0), 20.2),
    ],
)
def test_a_multicopter_flies_as_a_simulated_one_does(flown: float, seconds: float) -> None:
    """As flown by MAVSDK; how long a landing takes depends on when the vehicle tells of its end."""
    assert flown == pytest.approx(seconds, rel=0.02, abs=0.2)


def test_legs_vary_as_much_as_their_spread() -> None:
    """With all that is beside them, and what is done at their ends does not."""
    motion = replace(CRAZYFLIE.exact, spread=SPREAD)
    between = varied(motion, 1).flies(dist(NEAR, FAR), 0.5)
    assert_spread([(seconds - MEASURES) / between for seconds in to_and_fro(motion)])


def test_flights_vary_in_their_pace_and_in_what_a_take_off_takes() -> None:
    """All drones of one are alike; without a spread each flight is as expected."""
    motion = replace(CRAZYFLIE.exact, spread=0.03)
    flights = [varied(motion, seed) for seed in range(1000)]
    for values, expected, spread in (
        ([one.pace for one in flights], 1.0, 0.03),
        ([one.take_off for one in flights], motion.take_off, 0.3 * motion.take_off),
    ):
        assert fmean(values) == pytest.approx(expected, abs=0.1 * spread)
        assert pstdev(values) == pytest.approx(spread, rel=0.05)
    assert varied(CRAZYFLIE.exact, 1) == CRAZYFLIE.exact
    seconds = {to_and_fro(motion, seed, 1)[0] for seed in range(20)}
    assert max(seconds) - min(seconds) > 0.5


def test_durations_hang_on_the_seed_and_the_flight() -> None:
    """The same seed gives the same flights, whatever was flown before."""
    motion = replace(CRAZYFLIE, spread=SPREAD)
    first = to_and_fro(motion, seed=7, count=5)
    assert first == to_and_fro(motion, seed=7, count=5)
    assert first != to_and_fro(motion, seed=8, count=5)
    assert varies(1.0, "7/a/0") == varies(1.0, "7/a/0") != varies(1.0, "7/b/0")
    later = Ideal(kind(motion), seed=7)
    later.flies(FAR, flight="b")
    later.does("home")
    again = Ideal(kind(motion), seed=7)
    assert later.flies(NEAR) == pytest.approx(again.flies(NEAR))


# Legs with a limited jerk

steady = st.builds(
    Motion,
    legs=st.just("steady"),
    acceleration=st.floats(0.2, 10.0),
    jerk=st.floats(0.2, 50.0),
    pace=st.floats(0.5, 2.0),
    settles=overheads,
)
FINE = 4000


def integrated(metres: float, speed: float, rate: float, jerk: float) -> float:
    """Return the seconds of a leg by integration: half of it with the most jerk that its limits leave, and back.

    The other half is the same backwards; what is left between is flown at the speed.
    """
    step = 2 * sqrt(speed / min(jerk, rate)) / FINE + speed / rate / FINE
    at = fast = push = seconds = 0.0
    while fast < speed:
        # the acceleration must have gone by the time that the speed is reached
        gone = sqrt(max(0.0, 2 * jerk * (speed - fast)))
        push = min(push + jerk * step, rate, gone)
        grows = max(push * step, 1e-9 * speed)
        at += (fast + min(speed, fast + grows)) / 2 * step
        fast = min(speed, fast + grows)
        seconds += step
    if 2 * at > metres:
        return -1.0  # so short a way does not reach it
    return 2 * seconds + (metres - 2 * at) / speed


@given(steady, st.floats(0.2, 15.0), st.floats(0.1, 300.0))
@example(Motion(legs="steady", acceleration=3.0, jerk=4.0), 5.0, 100.0)
@example(Motion(legs="steady", acceleration=3.0, jerk=4.0), 1.0, 3.0)
def test_a_leg_takes_what_its_profile_takes(motion: Motion, speed: float, metres: float) -> None:
    """Integrated in small steps, where the speed is reached."""
    expected = integrated(metres, speed, motion.acceleration, motion.jerk)
    assume(expected > 0.0)
    assert motion.leg(metres, speed) == pytest.approx(motion.pace * expected, rel=0.01)


@given(steady, st.floats(0.2, 15.0), st.floats(0.001, 300.0), st.floats(1.0, 3.0))
def test_a_longer_leg_takes_longer_and_no_leg_is_faster_than_its_limits(
    motion: Motion, speed: float, metres: float, times: float
) -> None:
    """Not than its speed, its acceleration or its jerk allow; and a short one takes no more besides than is said."""
    seconds = motion.leg(metres, speed) / motion.pace
    assert motion.leg(times * metres, speed) >= motion.leg(metres, speed)
    assert seconds >= metres / speed
    assert seconds >= 2 * sqrt(metres / motion.acceleration) - 1e-9
    assert seconds >= (32 * metres / motion.jerk) ** (1 / 3) - 1e-9
    besides = motion.leg(metres, speed) - motion.at_speed(metres, speed)
    assert besides <= motion.shortness(speed) * (1 + 1e-9)


@given(steady, st.floats(0.2, 15.0), st.floats(0.01, 300.0))
def test_a_short_leg_peaks_at_the_speed_that_its_length_allows(
    motion: Motion, speed: float, metres: float
) -> None:
    """It takes just as long as one whose speed is not limited; and a limit that it reaches changes nothing abruptly."""
    free = motion.leg(metres, 1e6)
    assert motion.leg(metres, speed) >= free * (1 - 1e-9)
    without = replace(motion, jerk=0.0)
    assert motion.leg(metres, speed) >= without.leg(metres, speed) * (1 - 1e-9)
    stiff = replace(motion, jerk=1e9)
    assert stiff.leg(metres, speed) == pytest.approx(without.leg(metres, speed), rel=1e-3)


# In the wind

AHEAD = (10.0, 0.0, 0.0)
HERE = (0.0, 0.0, 0.0)


@given(st.floats(0.0, 14.9), st.floats(0.0, 6.3), st.floats(0.5, 15.0))
def test_no_leg_is_flown_faster_than_the_airspeed_allows(
    wind: float, turn: float, speed: float
) -> None:
    """Through the air; where there is room, it is flown at the category's speed or as fast as the air allows."""
    motion = replace(STEADY, wind=(wind * cos(turn), wind * sin(turn)))
    over_ground = motion.against(HERE, AHEAD, speed)
    through = hypot(over_ground - motion.wind[0], motion.wind[1])
    assert over_ground <= speed
    if over_ground > 0.1:
        assert through <= STEADY.airspeed + 1e-9
        assert over_ground == speed or through == pytest.approx(STEADY.airspeed)


def test_calm_air_changes_nothing() -> None:
    assert STEADY.against(HERE, AHEAD, 7.0) == 7.0
    assert replace(STEADY, wind=(8.0, 0.0)).against(HERE, AHEAD, 7.0) == 7.0
    assert replace(STEADY, wind=(-8.0, 0.0)).against(HERE, AHEAD, 10.0) == 7.0
    assert replace(STEADY, wind=(-8.0, 0.0)).against(HERE, (0.0, 0.0, 9.0), 10.0) == 10.0
