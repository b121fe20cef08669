"""Looks which Crazyflies are there: on all radio channels at the addresses that are asked for."""

from __future__ import annotations

import socket
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import BadInput

from ..drones.errors import LinkLost
from . import words
from .driver import load
from .worker import Worker

if TYPE_CHECKING:
    from cflib.crtp.radiodriver import _SharedRadioInstance as Radio

    from .options import Options

_RATES = ((2, "2M"), (1, "1M"), (0, "250K"))
"""As the dongle numbers them, and as a URI has them; most drones use the first."""
_CHANNELS = 125
_PROBE = 0xFF
_USUAL = "E7E7E7E7E7"
_LIMIT = 60.0
_ANSWER = 0.2


async def scan(options: Options) -> list[str]:
    """Return the URIs of all that answer; raise `LinkLost` where there is no radio to ask with."""
    worker = Worker("scan")
    try:
        return await worker.call(lambda: _look(options), _LIMIT)
    finally:
        worker.end()


def _look(options: Options) -> list[str]:
    found = [uri for uri in options.udp if _answers(uri)]
    if not options.addresses:
        return found
    load()
    from cflib.crtp.radiodriver import RadioManager

    try:
        radio = RadioManager.open(0)
    except Exception as error:  # cflib raises just that
        raise LinkLost(words.no_scan(words.cause(str(error)))) from error
    try:
        for address in options.addresses:
            found += _on_the_air(radio, address)
    finally:
        radio.close()
    return found


def _on_the_air(radio: Radio, address: str) -> list[str]:
    bytes_ = _bytes(address)
    radio.set_address(bytes_)
    radio.set_arc(1)
    found = []
    for number, rate in _RATES:
        radio.set_data_rate(number)
        for channel in radio.scan_channels(0, _CHANNELS, (_PROBE,)):
            uri = f"radio://0/{channel}/{rate}"
            name = bytes(bytes_).hex().upper()
            found.append(uri if name == _USUAL else f"{uri}/{name}")
    return found


def _bytes(address: str) -> tuple[int, ...]:
    try:
        found = tuple(bytes.fromhex(address.rjust(10, "0")))
    except ValueError:
        found = ()
    if len(found) != 5:
        raise BadInput(words.no_address(address))
    return found


def _answers(uri: str) -> bool:
    """Say whether somebody answers to a probe by UDP."""
    host, _, port = uri.removeprefix("udp://").rpartition(":")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asking:
        asking.settimeout(_ANSWER)
        try:
            asking.connect((host, int(port)))
            asking.send(bytes((_PROBE,)))
            return bool(asking.recv(64))
        except (OSError, ValueError):
            return False
