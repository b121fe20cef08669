"""The simulated drone does what real firmware (2026.08) was measured to do, within a tolerance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import dist, hypot
from statistics import median

import pytest

from pluto_fleet.crtp.drone import Build
from tests.library.crtp.bench import CF1, Bench, hovering

PEAK = 2.19
"""Peak speed over mean speed of a course."""


def variances(build: Build, told: Callable[[Bench], None] = lambda _: None) -> list[float]:
    """Return what a drone at rest says of itself over ten seconds."""
    bench, found = Bench(build), []
    for tick in range(1, 1001):
        bench.passes(0.01)
        if tick % 5 == 0:
            told(bench)
        if tick % 3 == 0 and tick > 100:
            found.append(bench.drone.variance)
    return found


@pytest.mark.parametrize(("rate", "measured"), [(100.0, 44e-5), (20.0, 64e-5), (10.0, 84e-5)])
def test_its_variance_at_rest_is_as_measured_for_each_rate_of_positions(
    rate: float, measured: float
) -> None:
    found = variances(replace(CF1, rate=rate))
    assert median(found) == pytest.approx(measured, rel=0.1)
    assert max(found) < 1.3 * measured


@pytest.mark.parametrize(("noise", "rate"), [(0.08, 500.0), (0.1, 100.0), (0.15, 100.0)])
def test_by_uwb_it_is_less_sure(noise: float, rate: float) -> None:
    assert all(0.0015 < one <= 0.0032 for one in variances(replace(CF1, noise=noise, rate=rate)))


def test_without_positions_it_grows_and_the_drone_goes_astray_and_says_nothing_of_it() -> None:
    bench = hovering()
    bench.passes(2.0)
    bench.let("fixes", False)
    info = bench.drone.info()
    bench.passes(2.5)
    assert 0.05 < bench.drone.variance < 0.2
    bench.passes(8.5)
    assert bench.drone.variance == pytest.approx(2.5, rel=0.05)
    assert bench.drone.info() == info
    assert dist(bench.drone.body.estimate, (1.0, 2.0, 1.0)) < 0.3
    assert 1.5 < dist(bench.drone.body.position, (1.0, 2.0, 1.0)) < 3.0


def late(metres: float, speed: float) -> tuple[float, float]:
    """Return how long such a course takes, and how much longer than planned, to rest near its end."""
    bench = hovering(replace(CF1, home=(0.0, 2.0, 0.0)))
    bench.passes(5.0)
    planned = PEAK * metres / speed
    bench.go_to(metres, 2.0, 1.0, planned)
    took = 0.0
    while took < planned or bench.x < metres - 0.1 or fast(bench) > 0.1:
        bench.passes(0.01)
        took += 0.01
        assert took < 60.0 and fast(bench) < 1.15
    return took, took - planned


def fast(bench: Bench) -> float:
    vx, vy, _ = bench.drone.body.velocity
    return hypot(vx, vy)


def test_a_course_that_is_planned_too_fast_ends_as_late_as_measured() -> None:
    assert late(6.0, 3.0)[1] == pytest.approx(2.8, abs=0.3)
    assert late(15.0, 2.0)[0] == pytest.approx(16.6, rel=0.08)


def test_a_hold_at_speed_shoots_on_as_far_as_measured() -> None:
    bench = hovering(replace(CF1, home=(0.0, 2.0, 0.0)))
    bench.go_to(6.0, 2.0, 1.0, PEAK * 6.0 / 1.2)
    while fast(bench) < 0.93:
        bench.passes(0.01)
    here = farthest = bench.x
    bench.go_to(here + 0.186, 2.0, 1.0, 1.0)
    for _ in range(300):
        bench.passes(0.01)
        farthest = max(farthest, bench.x)
    assert farthest - here == pytest.approx(0.58, abs=0.08)


@pytest.mark.parametrize(
    ("height", "speed", "peak", "later"),
    [(1.5, 1.0, 1.60, None), (1.6, 0.5, 1.706, 1.655), (1.6, 0.6, 1.706, 1.655)],
)
def test_a_takeoff_overshoots_as_much_as_measured_and_sinks_back_as_slowly(
    height: float, speed: float, peak: float, later: float | None
) -> None:
    bench = Bench()
    bench.arm()
    bench.takeoff(height, PEAK * height / speed)
    bench.passes(1.0)
    heights = [bench.z]
    while bench.z > max(heights) - 0.02:
        bench.passes(0.01)
        heights.append(bench.z)
    highest = heights.index(max(heights))
    assert max(heights) == pytest.approx(peak, abs=0.03)
    bench.passes(3.0 - 0.01 * (len(heights) - 1 - highest))
    assert later is None or bench.z == pytest.approx(later, abs=0.025)
    bench.passes(9.0)
    assert bench.z == pytest.approx(height, abs=0.03)
