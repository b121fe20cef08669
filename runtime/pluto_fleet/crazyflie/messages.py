"""Messages about Crazyflies that are used in several places or need some composing."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite, sqrt
from typing import TYPE_CHECKING

from ..files.reading import near
from ..shared.domain.text import number, quoted

if TYPE_CHECKING:
    from ..shared.domain.model import Point


PROTOCOL = 12
"""The least protocol version of the firmware, since which it reports its supervisor's state."""


NO_CFLIB = "to fly Crazyflies, cflib is needed: pip install 'pluto-fleet[crazyflie]'"


# The link


def not_connected(drone: str) -> str:
    return f"{drone} is not connected"


def ended(drone: str, why: str) -> str:
    return f"the link to {drone} was lost: {why}"


WHILE_SENDING = "it was closed while something was sent"


def stuck(drone: str, seconds: float) -> str:
    return f"the radio did not take a command for {drone} in {number(seconds)} s"


def cause(message: str) -> str:
    """Return a short reason for an error of cflib."""
    first = (message.strip().splitlines() or [""])[0].removeprefix("Couldn't load link driver: ")
    whole = message.lower()
    if "cannot find a crazyradio" in whole or "cannot find radio" in whole:
        return "no Crazyradio is plugged in"
    if "access denied" in whole or "insufficient permissions" in whole:
        return "this user may not use the Crazyradio: it needs a udev rule, see docs/crazyflie.md"
    if "no backend available" in whole:
        return "USB cannot be used here: libusb is missing"
    if "no driver found" in whole:
        return "the uri is no radio://, usb:// or udp:// address"
    if "unplugged" in whole:
        return "the Crazyradio was unplugged"
    if "too many packets lost" in whole:
        return "too many packets are lost: it is off, or out of range"
    if "connection refused" in whole:
        return "no program listens there"
    return first or "cflib does not say why"


# Commands


def outside(drone: str, target: Point) -> str:
    x, y, z = (number(value) for value in target)
    return f"{drone} cannot go to ({x}, {y}, {z}): it must be finite, and above the ground"


def not_begun(drone: str, command: str) -> str:
    return f"{drone} acknowledged the command {command}, and does not move"


def not_arrived(drone: str, what: str, off: float) -> str:
    return f"{drone} has not {what} in time: {number(off)} m are missing"


def locked(drone: str, deck_failed: bool) -> str:
    why = ", as one of its decks reports a fault" if deck_failed else ""
    return f"{drone} has locked its motors{why}: switch it off and on"


# Its state, without names


LIES = "it lies on its back or has crashed"
HAS_CRASHED = (
    "it has crashed: once it stands upright and is whole, bring it back, or switch it off and on"
)
DECK_FAILED = "one of its decks reports a fault: see that all sit well, and switch it off and on"
IS_LOCKED = "it has locked its motors: switch it off and on"
LOCKED_BY_DECK = f"one of its decks reports a fault, and {IS_LOCKED}"


_RELEASES = {8: "2024.10", 9: "2025.02", 10: "2025.09 or 2025.12", 12: "2026.04 or 2026.08"}
"""Bitcraze's releases, by the protocol that they speak."""


def release(version: int) -> str:
    """Return the release of a firmware by its protocol: which exactly, that does not say."""
    if version in _RELEASES:
        return _RELEASES[version]
    before = [name for protocol, name in _RELEASES.items() if protocol < version]
    after = [name for protocol, name in _RELEASES.items() if protocol > version]
    if not before:
        return f"before {after[0]}"
    return f"after {before[-1].rpartition(' ')[2]}"


def old_firmware(version: int) -> str:
    has = "too old to say which" if version < 0 else f"{version} (release {release(version)})"
    return (
        f"its firmware speaks protocol {has}, {PROTOCOL} or later is needed:"
        " flash the newest release with cfclient (Connect, Bootloader)"
    )


def little(volts: float, least: float, cells: int) -> str:
    each = "" if cells == 1 else " in each cell"
    return f"its battery has {volts:.2f} V{each} at rest, {least:.2f} V are needed: charge it"


def more_cells(volts: float, cells: int, least: int) -> str:
    have = "one cell has" if cells == 1 else f"{cells} cells have"
    return (
        f"its battery has {volts:.2f} V, more than {have}: say in the fleet file how many"
        f" it has, such as cells = {least}"
    )


def uncertain(variance: float | None, within: float) -> str:
    if variance is None:
        return "it does not say how sure it is of its position"
    if variance <= within**2:
        return "it has not said for a second that it is sure where it is: let it stand still"
    return (
        f"it is not sure where it is: to {deviation(variance)} (a variance of {variance:.4f} m²),"
        f" and {number(within)} m for a second are needed, its option sure_within"
    )


def deviation(variance: float) -> str:
    """Format a variance as a standard deviation."""
    return f"{sqrt(variance):.2f} m" if isfinite(variance) else "any distance"


def adrift(variance: float) -> str:
    return (
        f"it may be {deviation(variance)} from where it believes to be: it does not see its beacons"
        " any more, or is not told where it is"
    )


def lost_its_place(drone: str, variance: float) -> str:
    return f"{drone} does not know where it is: {adrift(variance)}"


UNSETTLED = "its estimate of where it is has not settled: let it stand still on the ground"


def too_fast(speed: float, parameter: str, limit: float) -> str:
    return (
        f"it is to fly at up to {number(speed)} m/s, and its firmware follows no course faster than"
        f" {number(limit)} m/s ({parameter}): give its category a lower speed, or set that parameter"
    )


def no_deck(deck: str, found: Sequence[str]) -> str:
    has = f"it has {', '.join(found)}" if found else "it has none"
    return f"it has no deck {quoted(deck)}: {has}"


UNREAD = "its parameters could not be read"


# Variables, parameters, actions


def no_variable(drone: str, name: str) -> str:
    return f"{drone} has no log variable {quoted(name)}"


def no_parameter(drone: str, name: str, known: Iterable[str] = ()) -> str:
    return f"{drone} has no parameter {quoted(name)}{near(name, known)}"


def nothing_to_read(drone: str, name: str) -> str:
    said = f"{drone} has neither a log variable nor a parameter {quoted(name)}"
    if "." in name:
        return said
    return f'{said}; what a quantity is read from, the fleet file says: measure = {{ {name} = "group.name" }}'


def bad_value(drone: str, name: str, value: float, kind: str) -> str:
    return f"{drone}: {number(value)} is no value for {quoted(name)}, which is a {kind}"


def not_read(drone: str, name: str) -> str:
    return f"{drone} does not tell {quoted(name)}"


def no_quantity(drone: str, quantity: str, known: Sequence[str]) -> str:
    has = f"it measures {', '.join(known)}; " if known else ""
    return (
        f"{drone} cannot measure {quoted(quantity)}: {has}name its log variable in the fleet file:"
        f' measure = {{ {quantity} = "group.name" }}'
    )


def no_camera(drone: str) -> str:
    return (
        f"{drone} has no camera: name its AI-deck's streamer in the fleet file:"
        ' camera = "192.168.4.1:5000"'
    )


def no_pictures(camera: tuple[str, int], error: OSError) -> str:
    why = error.strerror or "nothing came in time"
    return (
        f"its camera does not answer at {camera[0]}:{camera[1]} ({why}): is its AI-deck on, and this computer"
        " in its WiFi? For a plan without photos, leave camera out of the fleet file"
    )


def no_grip(drone: str) -> str:
    return (
        f"{drone} cannot pick or release: name the parameter of its gripper in the fleet file:"
        ' grip = { parameter = "gripper.closed", pick = 1, release = 0 }'
    )
