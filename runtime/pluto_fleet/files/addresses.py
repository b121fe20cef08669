"""The addresses of Crazyflies: read as cflib reads them, and refused where that would be a surprise.

What is accepted here means to cflib just what it means here. What cflib would take for something else
without a word (a rate that it does not know is 2M, an address of three bytes is filled up with zeros) is
refused. Needs neither cflib nor a radio.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from itertools import combinations

from ..shared.domain.text import quoted
from .vehicle_addresses import is_vehicle, vehicle_address

SUCH_AS = "radio://0/80/2M/E7E7E7E7E7"
USUAL = "E7E7E7E7E7"
"""The radio address of a new drone, and of a URI that names none."""
RATES = ("2M", "1M", "250K")
"""The first is that of a URI that names none."""
CHANNELS = 126
"""From 0 on, 1 MHz each from 2400 MHz."""
WELL = 10
"""Drones of one dongle beyond which there is a warning: see docs/crazyflie.md."""

_SERIAL = re.compile(r"[0-9A-Fa-f]{10,}")
_HEX = re.compile(r"[0-9A-Fa-f]+")
_WHOLE = re.compile(r"[0-9]{1,9}")
_MOST_DEVICES = 999


@dataclass(frozen=True, slots=True, kw_only=True)
class Address:
    """How one drone is reached."""

    uri: str
    """In its canonical form: all that it left out is there."""
    dongle: str = ""
    """The number or the serial number of the radio's dongle; empty: it is not reached by radio."""
    channel: int = 0
    rate: str = ""

    @property
    def drone(self) -> str:
        """Which drone it reaches: the same by whichever dongle."""
        return self.uri.replace(f"//{self.dongle}/", "//", 1) if self.dongle else self.uri


def address_of(uri: str) -> Address:
    """Read an address; raise `ValueError` with what is wrong with it, to be said after the address."""
    scheme, marked, rest = uri.partition("://")
    if not marked or scheme not in _SCHEMES:
        hint = f"it begins with {', '.join(f'{one}://' for one in _SCHEMES)}; such as {SUCH_AS}"
        if marked and scheme.lower() in _SCHEMES:
            hint = f"write {scheme.lower()}:// in small letters"
        raise ValueError(f"is no address of a Crazyflie: {hint}")
    if not rest.isascii() or not rest.isprintable() or set(rest) & set(" #@"):
        raise ValueError(f"has a character that no address has; write it like {SUCH_AS}")
    return (
        _radio(rest) if scheme == "radio" else Address(uri=f"{scheme}://{_by_wire(scheme, rest)}")
    )


def radio_bytes(text: str) -> bytes:
    """Return the five bytes of a radio address; raise `ValueError` with what is wrong with it."""
    if not _HEX.fullmatch(text):
        raise ValueError(f"{quoted(text)} is no radio address: {_TEN}")
    if len(text) != len(USUAL):
        digits = "1 digit" if len(text) == 1 else f"{len(text)} digits"
        raise ValueError(f"{quoted(text)} is a radio address of {digits}: {_TEN}")
    return bytes.fromhex(text)


_TEN = f"it has five bytes, ten hexadecimal digits, such as {USUAL}"


def _radio(rest: str) -> Address:
    path, _, query = rest.partition("?")
    dongle, _, path = path.partition("/")
    parts = path.strip("/").split("/")
    if len(parts) > 3:
        raise ValueError(f"goes on behind its radio address; write it like {SUCH_AS}")
    channel, rate, address = (*parts, "", "")[:3]
    dongle = _dongle(dongle)
    number = _channel(channel)
    rate = _rate(rate)
    try:
        named = radio_bytes(address or USUAL).hex().upper()
    except ValueError as error:
        raise ValueError(f"names no drone: {error}") from None
    _check_query(query)
    return Address(
        uri=f"radio://{dongle}/{number}/{rate}/{named}", dongle=dongle, channel=number, rate=rate
    )


def _dongle(text: str) -> str:
    if _WHOLE.fullmatch(text) and int(text) <= _MOST_DEVICES:
        return str(int(text))
    if _SERIAL.fullmatch(text):
        return text.upper()
    raise ValueError(
        f"names no dongle: {quoted(text)} is neither its number, which is 0 for the first, nor a"
        f" serial number; write it like {SUCH_AS}"
    )


def _channel(text: str) -> int:
    if not text:
        raise ValueError(f"names no channel; write it like {SUCH_AS}")
    if not _WHOLE.fullmatch(text) or int(text) >= CHANNELS:
        raise ValueError(
            f"names the channel {quoted(text)}: a Crazyradio has the channels 0 to {CHANNELS - 1};"
            " take the one that cfclient shows for this drone"
        )
    return int(text)


def _rate(text: str) -> str:
    """Return the rate; one in small letters is none to cflib, which takes 2M for it."""
    if text in ("", "2m", *RATES):
        return text.upper() or RATES[0]
    such = text.upper() if text.upper() in RATES else "one of them"
    raise ValueError(
        f"names the rate {quoted(text)}: there are {', '.join(RATES)}, and cflib would take any other"
        f" word for 2M; write {such}"
    )


def _check_query(query: str) -> None:
    """Check the one option that cflib reads."""
    from urllib.parse import parse_qs  # rarely needed

    limit = parse_qs(query).get("rate_limit", ["0"])[0]
    if not _WHOLE.fullmatch(limit):
        raise ValueError(
            f"limits its packets to {quoted(limit)}: rate_limit is a whole number, packets a second"
        )


_NETWORK = r"(?P<host>[A-Za-z0-9_.-]{1,255}):(?P<port>[0-9]{1,9})"
_BY_WIRE = {
    "usb": (r"[0-9]{1,3}", "usb://0, by the number of its cable"),
    "udp": (f"{_NETWORK}/?", "udp://192.168.4.1:5000"),
    "tcp": (f"{_NETWORK}/?", "tcp://192.168.4.1:5000"),
    "prrt": (f"{_NETWORK}(/[0-9]{{1,6}})?", "prrt://10.8.0.208:5000/100"),
    "serial": (r"[-a-zA-Z0-9/.]+", "serial://ttyACM0"),
}
"""How addresses are written that name no radio, and an example of each."""
_SCHEMES = ("radio", *_BY_WIRE)


def _by_wire(scheme: str, rest: str) -> str:
    """Return the canonical form of an address, without its scheme."""
    pattern, such = _BY_WIRE[scheme]
    match = re.fullmatch(pattern, rest)
    if match is None:
        raise ValueError(f"names no drone: write it like {such}")
    if scheme == "usb":
        return str(int(rest))
    if scheme == "serial":
        return rest
    host = match["host"].lower()
    port = int(match["port"])
    if not 0 < port < 65536:
        raise ValueError(f"names no port, a number from 1 to 65535; write it like {such}")
    if scheme == "prrt" or not set(host) - set("0123456789."):
        from ipaddress import AddressValueError, IPv4Address  # rarely needed

        try:
            IPv4Address(host)
        except AddressValueError:
            raise ValueError(
                f"names no host, four numbers up to 255; write it like {such}"
            ) from None
    return f"{'127.0.0.1' if host == 'localhost' else host}:{port}"


def which(uri: str) -> str:
    """Return a drone's uri in a canonical form, whichever dongle it names.

    What is no address that this library knows is compared as a text.
    """
    if is_vehicle(uri):
        with suppress(ValueError):
            return vehicle_address(uri.strip()).uri
        return uri.strip()
    with suppress(ValueError):
        return address_of(uri.strip()).drone
    return uri.strip().casefold().partition("?")[0].rstrip("/")


# What several on the air do to each other


def crowded_air(drones: Mapping[str, Address]) -> Iterator[str]:
    """Yield a warning for each dongle with too many drones, and for channels that are too near."""
    count = Counter(one.dongle for one in drones.values() if one.dongle)
    for dongle, many in count.items():
        if many > WELL:
            yield (
                f"{many} drones share the dongle {dongle}: one carries four or five well, and up to"
                f" {WELL} with patience (docs/crazyflie.md, What you need); plug in another one, and"
                " give it some of them"
            )
    users: dict[tuple[str, int, str], str] = {}
    for id, one in drones.items():
        if one.dongle:
            users.setdefault((one.dongle, one.channel, one.rate), id)
    told: set[tuple[int, int]] = set()
    for (first, of_first), (second, of_second) in combinations(users.items(), 2):
        pair = (min(first[1], second[1]), max(first[1], second[1]))
        if pair not in told and _disturb(first, second):
            told.add(pair)
            yield (
                f"{of_first} on channel {first[1]} and {of_second} on channel {second[1]} may disturb"
                f" each other{_how(first, second)}: at 2M a channel is 2 MHz wide, else 1 MHz (nRF24L01+"
                " Product Specification, 6.3); give them channels that are 2 apart"
            )


def _disturb(first: tuple[str, int, str], second: tuple[str, int, str]) -> bool:
    """Whether two channels overlap; one dongle never sends twice at once on the same."""
    apart = abs(first[1] - second[1])
    if apart == 0:
        return first[0] != second[0]
    return apart < 2 and "2M" in (first[2], second[2])


def _how(first: tuple[str, int, str], second: tuple[str, int, str]) -> str:
    return "" if first[0] == second[0] else f", by the dongles {first[0]} and {second[0]}"
