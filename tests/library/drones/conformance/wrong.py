"""Navigations that are wrong on purpose, each by one mistake: which check finds it, and what it says."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import AsyncIterator
from contextlib import suppress
from dataclasses import replace
from math import degrees, isfinite
from typing import ClassVar

from pluto_fleet.drones.conformance.contract import NavigationContract
from pluto_fleet.drones.conformance.recording import Truth
from pluto_fleet.drones.protocol import (
    DroneEvent,
    DroneNavigation,
    DroneTelemetry,
    LinkLost,
    Rejected,
)
from pluto_fleet.shared.domain.model import Point
from tests.kit.drones import YAW, FakeDrone, JumpingLoop

SPEED = 1.0


class FakeContract(NavigationContract):
    """The kit, over a fake drone in virtual time."""

    navigation: type[FakeDrone] = FakeDrone
    height, away, speed = 1.0, 2.0, SPEED
    may_fall = together = True
    loop_factory = JumpingLoop

    def make(self) -> DroneNavigation:
        return self.navigation()

    def make_unreachable(self) -> DroneNavigation:
        drone = self.navigation()
        drone.answers = False
        return drone

    def silence(self, navigation: DroneNavigation) -> None:
        assert isinstance(navigation, FakeDrone)
        navigation.goes_silent()

    def crash(self, navigation: DroneNavigation) -> None:
        assert isinstance(navigation, FakeDrone)
        navigation.falls()

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        assert isinstance(navigation, FakeDrone)
        return Truth(position=navigation.place, yaw=YAW, motors=navigation.motors)


class Wrong(FakeDrone):
    """A navigation with one mistake."""

    found_by: ClassVar[str]
    """The check of the kit that finds it."""
    says: ClassVar[str]
    """What the check says then."""


class Retelling(Wrong):
    """One that tells something else than its drone does."""

    def retold(self, told: DroneTelemetry) -> DroneTelemetry:
        """Return what it makes of what the drone told."""
        raise NotImplementedError

    @property
    def telemetry(self) -> DroneTelemetry:
        told = super().telemetry
        return self.retold(told) if isfinite(told.time) else told


def send() -> None:
    """Do what many libraries do: return when there is an answer."""
    for _ in range(4):
        time.sleep(0.05)


class Blocking(Wrong):
    """Calls a library that waits, on the event loop."""

    found_by = "test_the_event_loop_is_never_held_up"
    says = "wrong.py:"

    async def go_to(self, target: Point, speed: float) -> None:
        send()
        await super().go_to(target, speed)


class Clamping(Wrong):
    """Flies to the nearest place that it can reach, instead of refusing."""

    found_by = "test_a_bad_target_is_refused_before_anything_moves"
    says = "go_to below the ground was done, and not refused"

    async def go_to(self, target: Point, speed: float) -> None:
        x, y, z = target
        await super().go_to((x, y, max(z, 0.2)), speed)


class Deaf(Wrong):
    """Takes silence for consent."""

    found_by = "test_a_drone_that_falls_silent_is_a_lost_link"
    says = "returned as if nothing had happened"

    async def go_to(self, target: Point, speed: float) -> None:
        with suppress(LinkLost):
            await super().go_to(target, speed)


class Degrees(Retelling):
    """Tells degrees, as its library does."""

    found_by = "test_it_counts_in_metres_and_radians_in_the_maps_frame"
    says = "radians are between"

    def retold(self, told: DroneTelemetry) -> DroneTelemetry:
        return replace(told, yaw=degrees(told.yaw))


class Dropping(Wrong):
    """Lets go of its drone by switching it off, as its library does."""

    found_by = "test_closing_in_the_air_never_cuts_the_motors"
    says = "close cut the motors"

    async def close(self) -> None:
        if self.motors:
            self.motors = False
            await asyncio.sleep(0.1)
            self.falls(tells=False)
        await super().close()


class Drowsy(Retelling):
    """Tells where it is once a second."""

    found_by = "test_telemetry_is_fresh"
    says = "it told nothing new for"
    last: DroneTelemetry | None = None

    def retold(self, told: DroneTelemetry) -> DroneTelemetry:
        if self.last is None or told.time - self.last.time > 0.9:
            self.last = told
        return self.last


class Early(Wrong):
    """Returns when the drone has been told, and not when it is there."""

    found_by = "test_go_to_returns_on_arrival_and_not_before"
    says = "m before its target"

    async def go_to(self, target: Point, speed: float) -> None:
        going = asyncio.create_task(super().go_to(target, speed))
        await asyncio.wait([going], timeout=0.05)
        if going.done():
            await going


FOOT = 0.3048


class Feet(Retelling):
    """Hands metres to a library that counts in feet, and tells what that says."""

    found_by = "test_it_counts_in_metres_and_radians_in_the_maps_frame"
    says = "which units, and which frame?"

    async def takeoff(self, height: float, speed: float) -> None:
        await super().takeoff(height * FOOT, speed)

    async def go_to(self, target: Point, speed: float) -> None:
        x, y, z = target
        await super().go_to((x * FOOT, y * FOOT, z * FOOT), speed)

    def retold(self, told: DroneTelemetry) -> DroneTelemetry:
        x, y, z = told.position
        return replace(told, position=(x / FOOT, y / FOOT, z / FOOT))


class Forgetful(Wrong):
    """Lets go of everything when it is connected a second time, as after a lost link."""

    found_by = "test_it_connects_again_and_goes_on_telling"
    says = "it tells nothing any more"

    async def connect(self) -> None:
        await super().connect()
        if self.attempts > 1:
            self.goes_silent()


class Halting(Wrong):
    """Stops before it flies anywhere, also when it is on its way."""

    found_by = "test_it_follows_what_moves"
    says = "it stopped on its way"

    async def go_to(self, target: Point, speed: float) -> None:
        self.put(self.place)
        await asyncio.sleep(0.4)
        await super().go_to(target, speed)


class Hasty(Wrong):
    """Takes the speed for a wish."""

    found_by = "test_it_is_never_faster_than_it_was_told"
    says = "go_to at no more than 1.0 m/s flew at"

    async def go_to(self, target: Point, speed: float) -> None:
        await super().go_to(target, 2 * speed)


class Lingering(Wrong):
    """Leaves a thread behind that keeps the program from ending."""

    found_by = "test_closing_leaves_no_thread_task_or_socket"
    says = "the thread radio"
    over = threading.Event()

    async def connect(self) -> None:
        await super().connect()
        threading.Thread(target=self.over.wait, args=(60,), name="radio").start()


class Nameless(Wrong):
    """Refuses with an exception that says nothing of what it is to the app."""

    found_by = "test_go_to_is_refused_on_the_ground"
    says = "a refusal's failure is REFUSED"

    async def go_to(self, target: Point, speed: float) -> None:
        try:
            await super().go_to(target, speed)
        except Rejected as error:
            raise RuntimeError("state 3") from error


class Plunging(Wrong):
    """Lands by switching its motors off where it is."""

    found_by = "test_nothing_but_emergency_stop_cuts_the_motors"
    says = "its motors were off in the air"

    async def land(self, speed: float) -> None:
        self.motors = False
        await asyncio.sleep(0.1)
        self.falls(tells=False)


class Restless(Wrong):
    """Flies on when it has said that it holds."""

    found_by = "test_hold_stops_the_drone_here"
    says = "hold returned, and it moved"
    going: asyncio.Task[None] | None = None

    async def hold(self) -> None:
        if self.motors:
            self.going = asyncio.create_task(self.go_to((1000.0, 2.0, 1.0), SPEED))

    async def land(self, speed: float) -> None:
        if self.going is not None:
            self.going.cancel()
            await asyncio.wait([self.going])
        await super().land(speed)


class Tacit(Wrong):
    """Says of a crash only to the one who has given a command that it failed."""

    found_by = "test_a_drone_that_crashes_is_a_crash"
    says = "no event told that it crashed"

    async def events(self) -> AsyncIterator[DroneEvent]:
        async for event in super().events():
            if event.kind != "crashed":
                yield event


def all_wrong(kind: type[Wrong] = Wrong) -> list[type[Wrong]]:
    found: list[type[Wrong]] = []
    for one in kind.__subclasses__():
        found += [one] if hasattr(one, "found_by") else all_wrong(one)
    return found
