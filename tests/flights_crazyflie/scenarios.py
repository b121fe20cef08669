"""What goes wrong in the air, fault by fault, and how each flight must end all the same."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from pluto_fleet.crtp.battery import LOW
from tests.flights_crazyflie.flight import Flight
from tests.kill.lives import eventually
from tests.kill.trial import gateway_of

Doing = Callable[[Flight], None]

ALL = ("cf1", "cf2", "cf3", "cf4")
"""The drones of each of these flights; three missions are flown, so one of them has time."""


_CRASHED = 1 << 7
"""What a drone says of itself that has crashed, until it was asked to forget it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A fault, and what must come of it."""

    name: str
    before: Doing | None = None
    """What goes wrong before the app starts."""
    during: Doing | None = None
    """What goes wrong while it flies."""
    fails: str = ""
    """A pattern that the reason of a failed trip must match; empty: no trip fails."""
    falls: tuple[str, ...] = ()
    """The drones that may come down otherwise than by landing."""
    code: int = 0
    speed: float | None = None
    """Metres per second that its drones may fly; None: as fast as a Crazyflie follows."""
    refused: str = ""
    """A pattern of why nothing is flown; empty: missions are flown."""


def nothing(_: Flight) -> None:
    """Let all go well."""


def at_once(fault: str, value: float = True, *drones: str) -> Doing:
    """Return what lets something go wrong with drones."""

    def let(flight: Flight) -> None:
        for drone in drones or ("cf1",):
            flight.let(drone, fault, value)

    return let


def in_flight(fault: str, value: float = True) -> Doing:
    """Return what lets something go wrong with a drone once it flies."""

    def let(flight: Flight) -> None:
        flight.until_up("cf1")
        flight.let("cf1", fault, value)

    return let


def silent_for(seconds: float) -> Doing:
    """Return what keeps a drone from being heard in its flight, for a while."""

    def let(flight: Flight) -> None:
        flight.until_up("cf1")
        flight.let("cf1", "silent", True)
        flight.goes_on(seconds)
        flight.let("cf1", "silent", False)

    return let


def silent_until_empty(flight: Flight) -> None:
    """Silence a drone in its flight until its battery is empty, and it falls."""
    flight.until_up("cf1")
    flight.let("cf1", "silent", True)
    flight.let("cf1", "volts", LOW)


def kill_brain(flight: Flight) -> None:
    """Kill the app; the gateway must land all drones; then go on."""
    flight.until_up("cf1")
    flight.kill()
    began = time.monotonic()
    flight.until(lambda: not flight.airborne(), 30.0)
    flight.notes.append(f"all down {time.monotonic() - began:.1f} s after")
    flight.start()


def kill_gateway(flight: Flight) -> None:
    """Kill the gateway; the app must start it again."""
    flight.until_up("cf1")
    old = gateway_of(flight.journal)
    flight.kill_gateway()
    began = time.monotonic()
    flight.until(lambda: gateway_of(flight.journal) not in (None, old), 30.0)
    flight.notes.append(f"another one {time.monotonic() - began:.1f} s after")


def busy_for_a_while(flight: Flight) -> None:
    """Let a drone refuse each command in its flight, for some seconds."""
    flight.until_up("cf1")
    flight.let("cf1", "busy", True)
    flight.goes_on(6.0)
    flight.let("cf1", "busy", False)


def fetched(doing: Doing) -> Doing:
    """Return what does this, and lets a person fetch the drone a little later."""

    def let(flight: Flight) -> None:
        doing(flight)
        eventually(lambda: "cf1" not in flight.airborne(), 60.0)
        flight.goes_on(2.0)
        flight.let("cf1", "fetch", True)

    return let


def lost_and_found_again(flight: Flight) -> None:
    """Let a drone lose its place in its flight, and see its beacons again once it has landed."""
    in_flight("fixes", False)(flight)
    flight.until(lambda: "cf1" not in flight.airborne(), 30.0)
    flight.let("cf1", "fixes", True)


def stood_up(flight: Flight) -> None:
    """Let a drone tumble, and a person stand it up where it lies, and press Bring back."""
    in_flight("tumble")(flight)
    flight.until(lambda: any(one["event"] == "drone.lost" for one in flight.events))
    flight.let("cf1", "upright", True)
    flight.notes.append(flight.tell("bring-back", "cf1").strip())
    flight.until(lambda: not int(flight.state["cf1"]["info"]) & _CRASHED)


LOST_LINK = r"link|answer|silent|heard"
CRASH = r"tumbl|crash|turned over"
BATTERY = r"battery"
REFUSED = r"busy|refus|supervisor"
LOST_PLACE = r"does not know where it is"

SCENARIOS = (
    Scenario(name="nothing", during=nothing),
    Scenario(name="silent at connect", before=at_once("silent")),
    Scenario(name="nothing at its port", before=at_once("gone")),
    Scenario(
        name="silent in flight, for good",
        during=silent_until_empty,
        fails=LOST_LINK,
        falls=("cf1",),
    ),
    Scenario(name="link lost for 5 s", during=silent_for(5.0), fails=LOST_LINK),
    Scenario(name="tumbles", during=in_flight("tumble"), fails=CRASH, falls=("cf1",)),
    Scenario(
        name="tumbles, and is fetched",
        during=fetched(in_flight("tumble")),
        fails=CRASH,
        falls=("cf1",),
    ),
    Scenario(name="locks", during=in_flight("lock"), fails=r"lock", falls=("cf1",)),
    Scenario(
        name="restarts in flight",
        during=in_flight("restart"),
        fails=rf"{LOST_LINK}|{CRASH}",
        falls=("cf1",),
    ),
    Scenario(name="battery to 3.2 V", during=in_flight("volts", 3.18), fails=BATTERY),
    Scenario(
        name="battery to 3.2 V, and is fetched",
        during=fetched(in_flight("volts", 3.18)),
        fails=BATTERY,
    ),
    Scenario(name="1 % of packets lost", before=at_once("loss", 0.01, *ALL)),
    Scenario(name="5 % of packets lost", before=at_once("loss", 0.05, *ALL)),
    Scenario(name="40 ms late each way", before=at_once("latency", 0.04, *ALL)),
    Scenario(name="busy before take-off", before=at_once("busy"), fails=REFUSED),
    Scenario(name="busy in flight", during=busy_for_a_while, fails=REFUSED),
    Scenario(name="locked before take-off", before=at_once("lock")),
    Scenario(name="unsure where it is", before=at_once("unsure")),
    Scenario(name="empty before take-off", before=at_once("level", 0.02)),
    Scenario(name="position lost", during=in_flight("fixes", False), fails=LOST_PLACE),
    Scenario(name="position lost, and found again", during=lost_and_found_again, fails=LOST_PLACE),
    Scenario(name="pre-empted by a set-point", before=at_once("setpoint", True, *ALL)),
    Scenario(
        name="pre-empted in flight",
        during=in_flight("setpoint"),
        fails=rf"{CRASH}|lock|on the ground",
        falls=("cf1",),
    ),
    Scenario(name="a deck's fault", before=at_once("deck")),
    Scenario(
        name="a deck's fault in flight", during=in_flight("deck"), fails=r"deck", falls=("cf1",)
    ),
    Scenario(name="too fast", speed=2.0, refused=r"follows no course faster than 1 m/s", code=2),
    Scenario(name="tumbles, and is stood up", during=stood_up, fails=CRASH, falls=("cf1",)),
    Scenario(name="as unsure as by radio beacons", before=at_once("noise", 0.15, *ALL)),
    Scenario(name="kill -9 of the brain", during=kill_brain),
    Scenario(name="kill -9 of the gateway", during=kill_gateway),
)
