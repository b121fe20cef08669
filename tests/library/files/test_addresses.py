"""Addresses of Crazyflies: what is accepted is the same to cflib, and what is refused says why.

`addresses.txt` has a line for each: the address, what cflib's own drivers make of it, and what is said here.
"""

from __future__ import annotations

import asyncio
import random
import re
from pathlib import Path

import pytest

from pluto_fleet.cli.preflight import check_real
from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.drones.protocol import DroneSetup, NotReady
from pluto_fleet.files.addresses import address_of, which
from pluto_fleet.files.fleet import fleet_of, shared_by_air
from pluto_fleet.files.reading import parsed
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.cli import fake_drones
from tests.library.files.an_app import APP

TABLE = Path(__file__).parent / "sentences" / "addresses.txt"
COLUMNS = (50, 40)
USUAL = "radio://0/80/2M/E7E7E7E7E7"


class Links:
    """What cflib's drivers ask for when they are told to connect, which is given to none of them."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        from cflib.crtp import prrtdriver, serialdriver, tcpdriver, udpdriver, usbdriver
        from cflib.drivers import crazyradio

        monkeypatch.setattr(crazyradio, "get_serials", lambda: ("E7E7E7E701",))
        monkeypatch.setattr(udpdriver.socket, "socket", lambda *_: self)
        monkeypatch.setattr(tcpdriver, "SocketTransport", lambda *where: self.connect(where))
        monkeypatch.setattr(usbdriver, "CfUsb", lambda devid: self.connect(("usb", devid)))
        devices = {"ttyACM0": "/dev/ttyACM0"}
        monkeypatch.setattr(serialdriver.SerialDriver, "get_devices", lambda _: devices)
        monkeypatch.setattr(serialdriver, "UARTTransport", lambda *where: self.connect(where))
        monkeypatch.setattr(prrtdriver, "prrt_installed", True)
        monkeypatch.setattr(prrtdriver, "prrt", self, raising=False)

    def connect(self, where: object) -> None:
        """Take it from the driver: nothing is reached."""
        raise ConnectionAbortedError(where)

    # cflib asks for it by this name
    def PrrtSocket(self, *_: object, **__: object) -> Links:  # noqa: N802
        return self

    def read(self, uri: str) -> str:
        """Return what cflib makes of an address, or what it says."""
        from cflib.crtp import (
            prrtdriver,
            radiodriver,
            serialdriver,
            tcpdriver,
            udpdriver,
            usbdriver,
        )
        from cflib.crtp.exceptions import WrongUriType

        try:
            dongle, channel, rate, address, _ = radiodriver.RadioDriver.parse_uri(uri)
            return f"{dongle} {channel} {('250K', '1M', '2M')[rate]} {bytes(address).hex().upper()}"
        except WrongUriType:
            pass
        except Exception as error:  # noqa: BLE001 - cflib raises just that
            return _words(error)
        for driver in (
            usbdriver.UsbDriver,
            serialdriver.SerialDriver,
            udpdriver.UdpDriver,
            prrtdriver.PrrtDriver,
            tcpdriver.TcpDriver,
        ):
            try:
                driver().connect(uri, None, None)
            except WrongUriType:
                continue
            except ConnectionAbortedError as reached:
                return " ".join(map(str, reached.args[0]))
            # what a parser of others raises stands in the table
            except Exception as error:  # noqa: BLE001
                return _words(error)
        return "no driver"


def _words(error: Exception) -> str:
    return f"({type(error).__name__}: {error})"[: COLUMNS[1] - 2]


def ours(uri: str) -> str:
    """Return the canonical form, or what is said after the address."""
    try:
        return address_of(uri).uri
    except ValueError as error:
        return str(error)


def rows() -> list[list[str]]:
    lines = TABLE.read_text("utf-8").splitlines()
    return [re.split(r" {2,}", line, maxsplit=2) for line in lines]


@pytest.fixture
def cflib(monkeypatch: pytest.MonkeyPatch) -> Links:
    pytest.importorskip("cflib")
    return Links(monkeypatch)


def test_the_table_of_addresses_stands_as_it_is(cflib: Links, update: bool) -> None:
    """Each says what cflib makes of it beside what is made of it here."""
    every = [row[0] for row in rows()]
    assert len(set(every)) == len(every) >= 60
    now = [f"{uri:<{COLUMNS[0]}}{cflib.read(uri):<{COLUMNS[1]}}{ours(uri)}" for uri in every]
    if update:
        TABLE.write_text("\n".join(now) + "\n", "utf-8")
    assert TABLE.read_text("utf-8").splitlines() == now


def test_what_is_accepted_is_the_very_same_to_cflib(cflib: Links) -> None:
    """In its canonical form, too; so nothing else is reached than what the file says."""
    draw = random.Random(38)
    parts = (
        ["radio://", "radio://", "udp://", "usb://", "RADIO://"],
        ["0", "00", "1/", "e7e7e7e701", "127.0.0.1", "LOCALHOST", "x", ""],
        ["/80", "/080", "/126", ":19850", "/8_0", "/-1", ""],
        ["/2M", "/2m", "/1M", "/1m", "/250K", "/3M", "/", ""],
        ["/E7E7E7E7E7", "/e7e7e7e702", "/E7", "/0xE7E7E7E7", "/", ""],
        ["?rate_limit=9", "?rate_limit=x", "?safelink=0&rate_limit=9", "#1", "/", " ", ""],
    )
    accepted = 0
    for _ in range(20_000):
        uri = "".join(map(draw.choice, parts))
        try:
            read = address_of(uri)
        except ValueError:
            continue
        accepted += 1
        told = cflib.read(uri).replace("localhost", "127.0.0.1")
        assert told == cflib.read(read.uri) and not told.startswith("("), uri
        assert address_of(read.uri) == read
    assert accepted > 250


@pytest.mark.parametrize(
    "other",
    [
        "radio://0/80",
        "radio://0/80/2M",
        "radio://0/080/2M/e7e7e7e7e7",
        "radio://0/80/2m/",
        "radio://1/80/2M",
        "radio://e7e7e7e701/80?rate_limit=100",
    ],
)
def test_two_drones_at_one_address_are_one(other: str) -> None:
    """However it is written, and by whichever dongle."""
    with pytest.raises(BadInput, match="line 3: it would be one and the same drone"):
        fleet_of(parsed("f.toml", fleet(USUAL, other)), APP)
    assert which(other) == which(USUAL)


def test_a_wrong_address_is_told_with_its_line_unless_another_navigation_reads_it() -> None:
    """What an address is, each navigation says of its own."""
    wrong = fleet(USUAL, "radio://0/126/2M")
    with pytest.raises(BadInput, match=r'^f\.toml:8: drone "b": uri .* names the channel "126"'):
        fleet_of(parsed("f.toml", wrong), APP)
    other = f'[fleet]\nnavigation = "my_drones:Wren"\n{wrong}'
    assert fleet_of(parsed("f.toml", other), APP).drones[1].uri == "radio://0/126/2M"


def test_a_link_is_not_opened_at_a_wrong_address(tmp_path: Path) -> None:
    """Nor by a program that makes its drones itself."""
    setup = DroneSetup(
        id="cf1", uri="radio://0/80/3M", home=(0, 0, 0), speed=1.0, options={}, folder=tmp_path
    )
    with pytest.raises(NotReady, match='cf1: uri "radio://0/80/3M" names the rate "3M"'):
        asyncio.run(Crazyflie(setup).connect())


@pytest.mark.parametrize(
    ("second", "said"),
    [
        ("fake://nowhere", 'b: uri "fake://nowhere" is of no fake'),
        ("fake://01", "b: uri is that of a: it would be one and the same drone"),
        ("fake://2", ""),
    ],
)
def test_any_navigation_may_say_what_an_address_is(second: str, said: str) -> None:
    """It is asked before anything flies, and by a dry run."""
    named = f'[fleet]\nnavigation = "{fake_drones.__name__}:Counted"\n'
    read = fleet_of(parsed("f.toml", named + fleet("fake://1", second)), APP)
    if not said:
        check_real(APP, read, "f.toml", stand_ins=False)
        return
    with pytest.raises(BadInput, match=said):
        check_real(APP, read, "f.toml", stand_ins=False)


@pytest.mark.parametrize(
    ("uris", "said"),
    [
        (["radio://0/80", "radio://0/81/2M/E7E7E7E702"], ["a on channel 80 and b on channel 81"]),
        (["radio://0/80", "radio://1/80/2M/E7E7E7E702"], [", by the dongles 0 and 1"]),
        (["radio://0/80/1M", "radio://1/81/250K"], []),
        (["radio://0/80/1M", "radio://1/81/2M"], ["2 MHz wide"]),
        (["radio://0/80", "radio://0/82/2M/E7E7E7E702"], []),
        ([f"radio://0/80/2M/E7E7E7E7{n:02}" for n in range(10)], []),
        ([f"radio://0/80/2M/E7E7E7E7{n:02}" for n in range(11)], ["11 drones share the dongle 0"]),
        ([f"udp://127.0.0.1:{19850 + n}" for n in range(11)], []),
    ],
)
def test_drones_in_each_others_way_on_the_air_are_warned_of(
    uris: list[str], said: list[str]
) -> None:
    """Once for each pair of channels, and for each dongle, with where the figure is from."""
    found = shared_by_air(fleet_of(parsed("f.toml", fleet(*uris)), APP))
    assert len(found) == len(said)
    assert all(word in sentence for word, sentence in zip(said, found, strict=True))
    assert all("docs/crazyflie.md" in one or "nRF24L01+" in one for one in found)


def test_drones_with_one_camera_are_warned_of() -> None:
    """Each AI-deck that comes as it does is at the same address."""
    ours = '[navigation.crazyflie]\ncamera = "192.168.4.1:5000"\n'
    (said,) = shared_by_air(fleet_of(parsed("f.toml", ours + fleet(USUAL, "usb://0")), APP))
    assert said.startswith("a, b have one camera, 192.168.4.1:5000")


def fleet(*uris: str) -> str:
    """Return a fleet file of drones with these addresses, five lines each."""
    return "".join(
        f'[[drone]]\nid = "{chr(97 + n)}"\nuri = "{uri}"\n'
        f'home = [{n + 1}, 1]\ncategory = "scout"\n'
        for n, uri in enumerate(uris)
    )
