"""The checks: each examines one flight, which is flown once for all of them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Mapping
from itertools import pairwise
from math import dist, hypot, isfinite, pi
from typing import Any
from unittest import SkipTest
from weakref import WeakKeyDictionary

from ...shared.domain.errors import Failure
from ..loading import NAVIGATION, problems
from ..protocol import CRASHED, LOCKED
from . import flights
from .flights import LOOK, Author
from .probes import LoopWatch, left_since, resources
from .recording import (
    FlightRecord,
    described,
    fell,
    known_failures,
    looks_without_news,
    moved,
    off_course,
    stands_still,
    stood,
    too_fast,
    units_differ,
)

_FLOWN: WeakKeyDictionary[type, dict[str, FlightRecord]] = WeakKeyDictionary()
"""The flights of each test class."""
_MISSING = {
    "make_unreachable": "no drone was tried that is not there",
    "silence": "no drone was tried that falls silent",
    "crash": "no drone was tried that crashes",
    "may_fall": "emergency_stop was not tried",
}


SETTLES = 2.0
"""Seconds after which a drone keeps pace with what it follows."""

_Flight = Callable[[], Coroutine[Any, Any, FlightRecord]]


async def _flying(wanted: Mapping[str, _Flight]) -> dict[str, FlightRecord]:
    """Fly all of these concurrently, and check what they leave behind."""
    before = resources()
    with LoopWatch() as loop:
        records = await asyncio.gather(*(flight() for flight in wanted.values()))
    left = await left_since(before)
    for record in records:
        record.blocked = loop.found
        record.left = left
    return dict(zip(wanted, records, strict=True))


class NavigationContract(Author):
    """What any navigation must do. Subclass it, and provide `make` and the optional hooks.

    pytest finds the checks by their names. Each test class flies each of its flights once, one after
    the other; a check whose hook is not provided is skipped.
    """

    # The flights, each flown when the first check needs it

    def _tour(self) -> FlightRecord:
        return self._flown("tour")

    def _closed_in_the_air(self) -> FlightRecord:
        return self._flown("closed in the air")

    def _flown(self, name: str) -> FlightRecord:
        flown = _FLOWN.setdefault(type(self), {})
        if name not in flown:
            all_of_it = self._flights()
            at_once = self.together and name != "tour"
            wanted = [one for one in all_of_it if one != "tour"] if at_once else [name]
            with asyncio.Runner(loop_factory=self.loop_factory) as runner:
                flown.update(runner.run(_flying({one: all_of_it[one] for one in wanted})))
        return flown[name]

    def _flights(self) -> Mapping[str, _Flight]:
        """Return the flights that can be flown with what is provided."""
        possible: dict[str, _Flight] = {
            "tour": lambda: flights.tour(self),
            "closed in the air": lambda: flights.closed_in_the_air(self),
            "followed": lambda: flights.followed(self),
        }
        if self._gives("make_unreachable"):
            possible["unreachable"] = lambda: flights.unreachable(self, self.make_unreachable)
        if self._gives("silence"):
            possible["silent"] = lambda: flights.struck(self, self.silence)
        if self._gives("crash"):
            possible["crashed"] = lambda: flights.struck(self, self.crash)
        if self.may_fall:
            possible["cut"] = lambda: flights.cut(self)
        return possible

    def _gives(self, hook: str) -> bool:
        return getattr(type(self), hook) is not getattr(Author, hook)

    def _needs(self, hook: str) -> None:
        """Skip a check if the author does not provide what it needs."""
        if not self._gives(hook):
            raise SkipTest(f"{hook} is not given: {_MISSING[hook]}")

    # Before and after flying

    def test_its_class_has_what_it_must_have(self) -> None:
        wrong = problems(NAVIGATION, self._tour().made)
        assert not wrong, "; ".join(wrong)

    def test_it_connects_and_knows_where_its_drone_is(self) -> None:
        step = self._tour().step("connect").done()
        told = step.after.telemetry
        assert isfinite(told.time), "connect returned before the drone had told anything"
        assert all(map(isfinite, told.position)), f"its position is {told.position}"
        assert not told.flying, "its drone flies once it is connected"
        assert 0 <= told.battery_level <= 1, f"battery_level is {told.battery_level}, not a share"

    def test_it_connects_again_and_goes_on_telling(self) -> None:
        """As after a lost link, though this one is well."""
        record = self._tour()
        record.step("connect again").done()
        after = record.during("after connect again")
        assert len({one.telemetry.time for one in after}) > 1, "it tells nothing any more"
        assert stands_still(after, self.tolerance), "it moved by connecting again"

    def test_preflight_has_no_reason_and_moves_nothing(self) -> None:
        record = self._tour()
        for name in ("preflight", "preflight in the air"):
            value = record.step(name).done().value
            assert isinstance(value, (list, tuple)) and all(
                isinstance(one, str) for one in value
            ), f"preflight must return a sequence of reasons, and returned {value!r}"
        value = record.step("preflight").value
        assert not value, f"a drone that is ready is not: {value}"
        samples = record.during("preflight", "after preflight")
        assert not any(one.telemetry.flying for one in samples), "it flew by preflight"
        assert moved(samples) < self.tolerance, "it moved by preflight"

    def test_closing_ends_its_events(self) -> None:
        record = self._tour()
        record.step("close").done()
        assert record.events_error is None, f"events raised {record.events_error!r}"
        assert record.events_ended, "events still goes on a second after close"

    def test_closing_leaves_no_thread_task_or_socket(self) -> None:
        for record in (self._tour(), self._closed_in_the_air()):
            record.step("close").done()
            assert not record.left, f"close leaves {', '.join(record.left)}"

    # In the air

    def test_takeoff_rises_straight_to_its_height(self) -> None:
        record = self._tour()
        step = record.step("takeoff").done()
        x, y, _ = step.before.telemetry.position
        z = step.after.telemetry.position[2]
        assert step.after.telemetry.flying, "after takeoff, telemetry says that it does not fly"
        assert (
            abs(z - self.height) <= self.tolerance
        ), f"takeoff to {self.height} m returned at {z:.2f} m"
        aside = max(
            hypot(one.telemetry.position[0] - x, one.telemetry.position[1] - y)
            for one in record.during("takeoff")
        )
        assert aside <= 2 * self.tolerance, f"takeoff went {aside:.2f} m aside"

    def test_go_to_returns_on_arrival_and_not_before(self) -> None:
        record = self._tour()
        x, y, _ = record.step("connect").done().after.telemetry.position
        target = (x + self.away, y, self.height)
        step = record.step("go_to").done()
        left = dist(step.after.telemetry.position, target)
        assert left <= self.tolerance, f"go_to returned {left:.2f} m before its target"
        drift = moved(record.during("after go_to"))
        assert drift <= 2 * self.tolerance, f"it moved on by {drift:.2f} m after go_to returned"

    def test_it_flies_along_the_axes_of_the_map(self) -> None:
        """By what it tells: one metre along x is along x, and straight."""
        step = self._tour().step("go_to").done()
        samples = self._tour().during("go_to")
        aside = off_course(samples, step.before.telemetry.position, (1.0, 0.0, 0.0))
        assert aside <= 2 * self.tolerance, f"on its way along x it was {aside:.2f} m off it"

    def test_it_counts_in_metres_and_radians_in_the_maps_frame(self) -> None:
        """By the truth where it is known; by likelihood if not."""
        record = self._tour()
        record.step("go_to").done()
        for sample in record.samples:
            turned = sample.telemetry.yaw
            assert (
                isfinite(turned) and abs(turned) <= 2 * pi
            ), f"yaw is {turned:.2f}: radians are between -3.15 and 3.15"
        different = units_differ(record.samples, 3 * self.tolerance, self.speed)
        assert different is None, str(different)

    def test_it_is_never_faster_than_it_was_told(self) -> None:
        record = self._tour()
        for name in ("takeoff", "go_to", "land"):
            record.step(name).done()
            speed = too_fast(record.during(name), self.speed, self.tolerance)
            assert (
                speed is None
            ), f"{name} at no more than {self.speed} m/s flew at {speed or 0:.2f}"

    def test_a_cancelled_command_ends_at_once_and_the_drone_tells_on(self) -> None:
        record = self._tour()
        record.step("go_to that is cancelled").done()
        times = {one.telemetry.time for one in record.during("cancel", "hold", "after hold")}
        assert len(times) > 1, "it told nothing any more once a command was cancelled"

    def test_hold_stops_the_drone_here(self) -> None:
        record = self._tour()
        step = record.step("hold").done()
        stopped = dist(step.before.telemetry.position, step.after.telemetry.position)
        assert stopped <= self.away, f"it flew {stopped:.2f} m on until it held"
        assert step.after.telemetry.flying, "after hold, telemetry says that it does not fly"
        drift = moved(record.during("after hold"))
        assert drift <= 2 * self.tolerance, f"hold returned, and it moved {drift:.2f} m further"

    def test_it_follows_what_moves(self) -> None:
        """Sent on twice a second, by `follow` or by `go_to`, it keeps near, and does not stop on its way."""
        record = self._flown("followed")
        step = record.step("follow").done()
        samples = record.during("follow")
        x, y, _ = step.before.telemetry.position
        starts = step.began + SETTLES
        ends = step.began + self.away / self.pace
        stopped = stood(samples, starts, ends - flights.AHEAD, self.pace / 4)
        assert stopped is None, f"it stopped on its way, {stopped:.1f} s after it had set out"
        far = max(
            dist(one.telemetry.position[:2], (x + self.pace * (one.at - step.began), y))
            for one in samples
            if starts < one.at < ends
        )
        most = self.pace * flights.AHEAD + 2 * self.tolerance
        assert far <= most, f"it was {far:.2f} m away from what moves at {self.pace} m/s"

    def test_landing_returns_with_the_motors_off(self) -> None:
        record = self._tour()
        after = record.step("land").done().after
        assert not after.telemetry.flying, "land returned, and telemetry says that it flies"
        assert after.truth is None or not after.truth.motors, "land returned with motors that turn"
        high = record.step("connect").after.telemetry.position[2] + 2 * self.tolerance
        assert after.telemetry.position[2] <= high, "land returned above the ground"

    def test_on_the_ground_land_and_hold_do_nothing(self) -> None:
        record = self._tour()
        for name in ("land on the ground", "hold on the ground"):
            record.step(name).done()
            samples = record.during(name, f"after {name}")
            assert stands_still(samples, self.tolerance), f"{name} moved it, or started its motors"

    def test_telemetry_is_fresh(self) -> None:
        """At least five times a second."""
        record = self._tour()
        samples = record.during("takeoff", "go_to", "after go_to", "go_to that is cancelled")
        record.step("go_to").done()
        for earlier, later in pairwise(samples):
            assert (
                earlier.telemetry.time <= later.telemetry.time <= later.at
            ), "telemetry's time goes back, or is later than now: it is time.monotonic()"
        gap = looks_without_news(samples) * LOOK
        assert gap <= 0.3, f"it told nothing new for {gap:.2f} s in flight"

    def test_the_event_loop_is_never_held_up(self) -> None:
        """Nor while the drone is silent, or not there."""
        for record in map(self._flown, self._flights()):
            assert not record.blocked, f"the event loop was held up {'; '.join(record.blocked)}"

    # What it must refuse

    def test_a_bad_target_is_refused_before_anything_moves(self) -> None:
        self._refused("go_to a place that is no number")
        self._refused("go_to below the ground")

    def test_a_bad_speed_is_refused_before_anything_moves(self) -> None:
        self._refused("go_to at no speed")

    def test_go_to_is_refused_on_the_ground(self) -> None:
        self._refused("go_to on the ground")

    def _refused(self, name: str) -> None:
        record = self._tour()
        step = record.step(name)
        assert step.error is not None, f"{name} was done, and not refused"
        failure = getattr(step.error, "failure", None)
        assert (
            failure == Failure.REFUSED.name
        ), f"{name} raised {step.error!r}: a refusal's failure is REFUSED"
        way = moved(record.during(name, f"after {name}"))
        assert way <= 2 * self.tolerance, f"{name} was refused, and moved it by {way:.2f} m"

    # What goes wrong

    def test_closing_in_the_air_never_cuts_the_motors(self) -> None:
        record = self._closed_in_the_air()
        record.step("close").done()
        assert not fell(record, self.speed), "close cut the motors of a drone in the air: it fell"

    def test_nothing_but_emergency_stop_cuts_the_motors(self) -> None:
        record = self._tour()
        record.step("land").done()
        assert not fell(record, self.speed), "its motors were off in the air"
        self._needs("may_fall")
        record = self._flown("cut")
        after = record.step("emergency_stop").done().after
        last = record.samples[-1]
        assert not last.telemetry.flying, "after emergency_stop, telemetry says that it flies"
        assert after.truth is None or not after.truth.motors, "emergency_stop left the motors on"

    def test_a_drone_that_is_not_there_is_a_lost_link(self) -> None:
        self._needs("make_unreachable")
        record = self._flown("unreachable")
        self._failed_by(record, "connect", Failure.LINK)

    def test_a_drone_that_falls_silent_is_a_lost_link(self) -> None:
        self._needs("silence")
        record = self._flown("silent")
        self._failed_by(record, "go_to", Failure.LINK)
        step, struck = record.step("go_to"), record.during("struck")
        assert struck, "it never fell silent"
        assert (
            step.after.telemetry.time < step.ended - 0.5
        ), "telemetry's time went on though the drone was silent: it is when the drone told it"
        assert step.ended - struck[0].at < 5, "it took more than 5 s to see that it was silent"

    def test_a_drone_that_crashes_is_a_crash(self) -> None:
        self._needs("crash")
        record = self._flown("crashed")
        self._failed_by(record, "go_to", Failure.CRASH)
        kinds = [event.kind for event in record.events]
        assert CRASHED in kinds or LOCKED in kinds, f"no event told that it crashed, only {kinds}"

    def _failed_by(self, record: FlightRecord, name: str, failure: Failure) -> None:
        step = record.step(name)
        assert step.error is not None, f"{name} returned as if nothing had happened"
        error = step.error
        assert (
            getattr(error, "failure", None) == failure.name
        ), f"{name} raised {described(error) if error else ''}: its failure is {failure.name}"

    def test_every_failure_is_one_that_the_runtime_knows(self) -> None:
        for record in (self._tour(), self._closed_in_the_air()):
            strange = known_failures(record)
            assert not strange, f"a mistake of the navigation: {'; '.join(strange)}"
