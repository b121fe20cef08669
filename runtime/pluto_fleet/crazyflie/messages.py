"""Messages about Crazyflies that are used in several places or need some composing."""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite, sqrt

from ..files.reading import near
from ..shared.domain.text import number, quoted

PROTOCOL = 12
"""The least protocol version of the firmware, since which it reports its supervisor's state."""


NO_CFLIB = "to fly Crazyflies, cflib is needed: pip install 'pluto-fleet[crazyflie]'"


# The link


def not_connected(drone: str) -> str:
    return f"{drone} is not connected"


def ended(drone: str, why: str) -> str:
    return f"the link to {drone} was lost: {why}"


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


def not_begun(drone: str, command: str) -> str:
    return f"{drone} acknowledged the command {command}, and does not move"


# Its state, without names


LIES = "it lies on its back or has crashed"
IS_LOCKED = "it has locked its motors: switch it off and on"
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


def deviation(variance: float) -> str:
    return f"{sqrt(variance):.2f} m" if isfinite(variance) else "any distance"


def adrift(variance: float) -> str:
    return (
        f"it may be {deviation(variance)} from where it believes to be: it does not see its beacons"
        " any more, or is not told where it is"
    )


def lost_its_place(drone: str, variance: float) -> str:
    return f"{drone} does not know where it is: {adrift(variance)}"


UNREAD = "its parameters could not be read"


# Variables, parameters, actions


def no_variable(drone: str, name: str) -> str:
    return f"{drone} has no log variable {quoted(name)}"


def no_parameter(drone: str, name: str, known: Iterable[str] = ()) -> str:
    return f"{drone} has no parameter {quoted(name)}{near(name, known)}"


def bad_value(drone: str, name: str, value: float, kind: str) -> str:
    return f"{drone}: {number(value)} is no value for {quoted(name)}, which is a {kind}"


def not_read(drone: str, name: str) -> str:
    return f"{drone} does not tell {quoted(name)}"
