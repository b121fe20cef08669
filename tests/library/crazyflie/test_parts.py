"""The parts of a Crazyflie's navigation that need no drone."""

from __future__ import annotations

import asyncio
from math import dist, inf, isclose, nan
from pathlib import Path
from random import Random
from threading import Event

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.crazyflie import driver, messages, trajectory
from pluto_fleet.crazyflie.driver import cache_folder
from pluto_fleet.crazyflie.health import AlarmDetector, BatteryGauge
from pluto_fleet.crazyflie.options import LOST_BEYOND, SURE_WITHIN, options_of
from pluto_fleet.crazyflie.state import PositionConfidence, State, state_of
from pluto_fleet.crazyflie.trajectory import SpeedLimits
from pluto_fleet.crazyflie.worker import Worker
from pluto_fleet.crtp.body import AxisState as Start
from pluto_fleet.crtp.body import Body, profile
from pluto_fleet.drones.errors import LinkLost
from pluto_fleet.drones.protocol import BATTERY_LOW
from pluto_fleet.lithium import level_at
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.domain.motion import PEAK, SHORTEST
from tests.kit.command import python

FLYING, TUMBLED, LOCKED_BIT = 1 << 4 | 1 << 8, 1 << 5, 1 << 6


def state(
    time: float,
    *,
    volts: float = 4.0,
    bits: int = 0,
    power: int = 0,
    x: float = 0.0,
    at: Point | None = None,
    sent: float | None = None,
) -> State:
    return State(
        time=time,
        sent=time if sent is None else sent,
        position=at or (x, 0.0, 1.0),
        yaw=0.0,
        volts=volts,
        power=power,
        bits=bits,
    )


# The worker


async def test_a_call_that_hangs_is_given_up_and_the_next_one_is_not_held_up() -> None:
    released = Event()
    worker = Worker("cf1")
    assert await worker.call(lambda: 5, 1.0) == 5
    with pytest.raises(ZeroDivisionError):
        await worker.call(lambda: 1 / 0, 1.0)
    with pytest.raises(LinkLost, match=r"did not take a command for cf1 in 0\.05 s"):
        await worker.call(released.wait, 0.05)
    with pytest.raises(LinkLost):  # at once: the thread is not waited for again
        await worker.call(lambda: 5, 1e9)
    released.set()
    worker.end()


def test_a_call_that_is_not_waited_for_any_more_is_not_made() -> None:
    made: list[str] = []

    async def use() -> None:
        worker, go = Worker("cf1"), Event()
        first = asyncio.create_task(worker.call(go.wait, 5.0))
        second = asyncio.create_task(worker.call(lambda: made.append("second"), 5.0))
        await asyncio.sleep(0)
        second.cancel()
        await asyncio.wait({second})
        go.set()
        await first
        await worker.call(lambda: made.append("third"), 5.0)
        worker.end()

    asyncio.run(use())
    assert made == ["third"]


# Courses


@given(metres=st.floats(0.0, 30.0), speed=st.floats(0.05, 5.0))
def test_no_course_is_faster_than_its_limit_nor_throws_the_drone_over(
    metres: float, speed: float
) -> None:
    seconds = trajectory.shortest_duration(metres, speed)
    course = profile(Start(0.0), metres, seconds)
    steps = [course.at(seconds * step / 100) for step in range(101)]
    assert max(step.velocity for step in steps) <= speed + 1e-6
    assert max(abs(step.acceleration) for step in steps) <= 10.0


@given(speed=st.floats(0.0, 3.0))
def test_a_drone_that_is_to_stop_stops_within_its_way_of_a_third_of_a_second(speed: float) -> None:
    target, seconds = trajectory.braking(state(0.0), state(0.1, x=speed * 0.1))
    begun = speed * 0.1
    course = profile(Start(begun, speed), target[0], seconds)
    farthest = max(course.at(seconds * step / 100).position for step in range(101))
    assert farthest - begun <= 0.28 * speed * seconds + 1e-6
    assert target[1:] == (0.0, 1.0)


@given(sent=st.floats(0.0, 16777.0), passed=st.floats(0.0, 9.0), x=st.floats(-500.0, 500.0))
def test_it_is_never_sent_far_to_stop_no_matter_what_its_telemetry_makes_believe(
    sent: float, passed: float, x: float
) -> None:
    target, seconds = trajectory.braking(state(0.0, sent=sent), state(0.1, x=x, sent=sent + passed))
    assert abs(target[0] - x) <= 1.0 + 1e-9 and SHORTEST <= seconds <= 5.0


def test_the_clock_of_the_log_begins_anew_in_flight() -> None:
    before, now = state(0.0, sent=16777.2), state(0.1, x=0.1, sent=0.084)
    assert now.since(before) == pytest.approx(0.1)
    assert trajectory.braking(before, now)[0][0] == pytest.approx(0.3, abs=0.001)


def near(_: State) -> float:
    return 0.0


def test_a_drone_hovers_once_it_has_not_moved_for_a_moment() -> None:
    """The end of its course says nothing: its commander waits there for the drone."""
    comes = [state(tick / 10, x=0.04 * tick) for tick in range(6)]
    sways = [state(tick / 10, x=0.02 * (tick % 2)) for tick in range(6)]
    assert not trajectory.hovers(comes, near) and trajectory.hovers(sways, near)
    assert not trajectory.hovers(sways[:3], near)  # that is not known yet
    stands = [state(0.5 + tick / 10, x=0.2) for tick in (1, 2, 3)]
    assert not trajectory.hovers([*comes, *stands[:2]], near)
    assert trajectory.hovers([*comes, *stands], near)
    assert not trajectory.hovers(sways, lambda _: nan)


def test_a_drone_that_shoots_over_arrives_once_it_stays_near() -> None:
    """Where it turns it is at rest, too."""
    metres = (0.0, 0.05, 0.08, 0.1, 0.11, 0.11, 0.1, 0.09, 0.07, 0.06, 0.05, 0.05)
    flown = [state(tick / 10, x=off) for tick, off in enumerate(metres)]
    told = [flown[: last + 1] for last in range(len(flown))]
    arrived = [trajectory.hovers(states, lambda one: one.position[0]) for states in told]
    assert arrived.index(True) == len(flown) - 1


# A drone that comes down fast from a detour shoots over by more than a decimetre, and creeps back.
@pytest.mark.parametrize("metres", [0.8, 1.3, 1.9, -1.1])
@pytest.mark.parametrize("seed", range(10))
def test_what_is_done_at_the_end_of_a_fast_climb_or_descent_is_done_within_a_decimetre(
    metres: float, seed: int
) -> None:
    body = Body((0.0, 0.0, 1.0 + max(0.0, metres)), Random(seed))
    target = (0.0, 0.0, body.position[2] - metres)
    seconds = SpeedLimits((1.0, 1.0, 1.0)).seconds(body.position, target, 1.0)
    body.fly(target, 0.0, seconds, 0.0, landing=False)
    told: list[State] = []
    arrived, ticks = inf, 0
    while (now := ticks / 100) < arrived + 1.0:
        body.step(now, 0.01)
        if ticks % 10 == seed:  # it tells where it is ten times a second
            told.append(state(now, at=body.position))
            there = trajectory.hovers(told[-10:], lambda one: one.distance(target))
            arrived = min(arrived, now) if there and now >= seconds else arrived
        if now >= arrived:
            assert dist(body.position, target) <= 0.1
        ticks += 1
    assert arrived < seconds + trajectory.SLACK


def test_a_course_is_followed_on_each_axis() -> None:
    pace = SpeedLimits((1.0, 0.8, 0.5))
    assert pace.seconds((0, 0, 1), (8, 0, 1), 3.0) == pytest.approx(PEAK * 10)
    assert pace.seconds((0, 0, 0), (0, 0, 2), 3.0) == pytest.approx(PEAK * 4)
    assert pace.seconds((0, 0, 1), (8, 0, 1), 0.5) == pytest.approx(PEAK * 16)
    assert list(SpeedLimits((inf, inf, inf)).too_slow_for(5.0)) == []


# The battery


@given(volts=st.floats(2.5, 4.5), more=st.floats(0.0, 1.0))
def test_a_battery_with_more_volts_is_fuller(volts: float, more: float) -> None:
    assert 0.0 <= level_at(volts) <= level_at(volts + more) <= 1.0


def test_volts_in_the_air_are_corrected_by_what_flying_costs() -> None:
    battery = BatteryGauge()
    battery.hear(state(0.0, volts=3.95))
    resting = battery.level
    for tick in range(1, 100):
        battery.hear(state(tick / 10, volts=3.55, bits=FLYING))
        assert isclose(battery.level, resting, abs_tol=0.02)
    battery.hear(state(10.0, volts=3.9))
    assert battery.level == level_at(3.9)


# AlarmDetector


def heard(states: list[State]) -> list[tuple[float, str]]:
    alarms = AlarmDetector()
    return [(one.time, event.kind) for one in states for event in alarms.hear(one)]


def test_a_battery_is_low_when_it_is_so_for_three_seconds_and_told_once() -> None:
    low = [state(tick / 10, volts=3.1) for tick in range(100)]
    assert heard(low) == [(3.0, BATTERY_LOW)]
    said = [state(tick / 10, volts=3.4, power=3) for tick in range(100)]
    assert heard(said) == [(3.0, BATTERY_LOW)]


def test_a_short_burst_is_no_alarm() -> None:
    burst = [state(tick / 10, volts=3.1 if tick % 20 else 3.3) for tick in range(100)]
    assert heard(burst) == []


def test_another_battery_can_be_low_again() -> None:
    flights = [*[3.1] * 50, *[4.1] * 10, *[3.1] * 50]
    told = heard([state(tick / 10, volts=volts) for tick, volts in enumerate(flights)])
    assert [kind for _, kind in told] == [BATTERY_LOW, BATTERY_LOW]


# What it tells


def test_a_state_is_in_radians_and_knows_its_bits() -> None:
    told = {"stateEstimate.yaw": 180.0, "supervisor.info": 0b1000011010, "pm.vbat": 4.0}
    read = state_of(told, 5.0, 1.0)
    assert read.yaw == pytest.approx(3.14159, abs=1e-4) and read.position == (0.0, 0.0, 0.0)
    assert read.armed and read.can_fly and read.flies and read.finished
    assert not (read.steered or read.crashed or read.locked)


def told(*variances: float, every: float = 0.25) -> PositionConfidence:
    certainty = PositionConfidence()
    for tick, variance in enumerate(variances):
        certainty.hear((1e-5, 1e-5, variance), tick * every)
    return certainty


@pytest.mark.parametrize("variance", [0.0004, 0.001, 0.003])
def test_one_seen_by_lighthouse_camera_or_radio_beacons_is_sure_enough(
    variance: float,
) -> None:
    """What was measured of drones at rest: radio beacons are the worst of them."""
    assert not told(*[variance] * 4).sure(0.75, SURE_WITHIN)
    assert told(*[variance] * 5).sure(1.0, SURE_WITHIN)


def test_one_not_sure_within_the_last_second_is_not_sure() -> None:
    assert not told(*[1e-5] * 8, 0.5).sure(2.0, SURE_WITHIN)
    assert not told(*[1e-5] * 8, nan).sure(2.0, SURE_WITHIN)
    assert told(*[1e-5] * 8, 0.5).variance == 0.5
    assert not told(*[1e-5] * 5, 0.02).sure(1.25, SURE_WITHIN)
    assert told(*[0.02] * 5).sure(1.0, 0.15)


def test_a_place_is_lost_once_it_has_been_unknown_for_a_second() -> None:
    growing = [0.003, 0.02, 0.06, 0.1, 0.2, 0.4]
    assert not told(*growing).lost(LOST_BEYOND) and told(*growing).doubts(LOST_BEYOND)
    assert told(*growing, 0.6).lost(LOST_BEYOND)
    assert not told(*growing, 0.6, 0.04).lost(LOST_BEYOND)
    assert not told(*growing, 0.6).lost(1.0) and not PositionConfidence().lost(LOST_BEYOND)


# Options


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"camra": "x"}, 'a Crazyflie has no option "camra"; it has measure,'),
        ({"camera": "192.168.4.1"}, "camera must be a host and a port"),
        ({"camera": "here:99999"}, "camera must be a host and a port"),
        ({"camera_view": [65]}, "camera_view must be two angles"),
        ({"camera_view": [65, True]}, "camera_view must be two angles"),
        ({"measure": "bme.temp"}, "measure must be a table"),
        ({"measure": {"dust": "pm25"}}, r"measure\.dust must be a log variable"),
        ({"grip": {"parameter": "a.b", "pick": 1}}, "grip must be a table"),
        ({"grip": {"parameter": "a.b", "pick": 1, "release": 0, "x": 1}}, "grip must be a table"),
        ({"decks": [1]}, "decks must be a list of texts"),
        ({"least_voltage": nan}, "least_voltage must be a number"),
        ({"sure_within": 0.0}, "sure_within must be a number of metres above 0"),
        ({"sure_within": 10**400}, "sure_within must be a number of metres above 0"),
        ({"lost_beyond": float("nan")}, "lost_beyond must be a number of metres above 0"),
        ({"sure_within": "7 cm"}, "sure_within must be a number of metres above 0"),
        ({"lost_beyond": 0.05}, r"lost_beyond must be at least sure_within, which is 0\.07"),
        ({"starts_at_home": 1}, "starts_at_home must be true or false"),
    ],
)
def test_an_option_that_cannot_be_used_is_named(given: dict[str, object], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        options_of(given)


def test_options_have_their_defaults() -> None:
    options = options_of({"camera": "[::1]:5000", "decks": "bcFlow2"})
    assert options.camera == ("::1", 5000) and options.decks == ("bcFlow2",)
    assert options.sure_within == 0.07 and options.lost_beyond == pytest.approx(0.05**0.5)
    assert options_of({"sure_within": 0.5}).lost_beyond == 0.5
    assert options.least_voltage == 3.7 and options.grip is None and dict(options.measure) == {}


# Tables of contents


def test_tables_are_kept_where_no_other_user_may_write(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """For cflib runs what it finds in them."""
    flight, cache = tmp_path / "flight", tmp_path / "cache"
    flight.mkdir()
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    ours = cache / "pluto" / "crazyflie"
    assert cache_folder(flight) == str(ours) and ours.stat().st_mode & 0o077 == 0
    ours.chmod(0o777)
    assert cache_folder(flight) == str(flight / "crazyflie")
    (flight / "crazyflie").chmod(0o777)
    assert cache_folder(flight) is None
    assert cache_folder(tmp_path / "nowhere") is None


# cflib


@pytest.mark.parametrize(
    ("cflib", "we"),
    [
        ("Couldn't load link driver: Cannot find a Crazyradio Dongle\n\nTraceback", "plugged in"),
        ("Couldn't load link driver: [Errno 13] Access denied (insufficient permi", "udev rule"),
        ("Couldn't load link driver: No backend available\n\nTraceback", "libusb"),
        ("No driver found or malformed URI: cf1", "no radio://"),
        ("Too many packets lost", "out of range"),
        ("Something new\nTraceback", "Something new"),
        ("", "does not say why"),
    ],
)
def test_cflib_s_tracebacks_become_reasons(cflib: str, we: str) -> None:
    assert we in messages.cause(cflib) and "\n" not in messages.cause(cflib)


def test_without_cflib_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(driver, "find_spec", lambda _: None)
    with pytest.raises(BadInput, match=r"cflib is needed: pip install 'pluto-fleet\[crazyflie\]'$"):
        driver.require()


@pytest.mark.process
def test_importing_the_navigation_imports_no_cflib() -> None:
    code = (
        "import sys; import pluto_fleet.crazyflie.navigation;"
        "print([name for name in sys.modules if name.partition('.')[0] in ('cflib', 'numpy')])"
    )
    assert python("-W", "error", "-c", code) == (0, "[]\n", "")
