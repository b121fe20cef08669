"""What lies between a drone and cflib: its thread, its tables, its errors, and the options of a fleet file."""

from __future__ import annotations

import asyncio
from math import nan
from pathlib import Path
from threading import Event

import pytest

from pluto_fleet.crazyflie import driver, messages
from pluto_fleet.crazyflie.driver import cache_folder
from pluto_fleet.crazyflie.options import options_of
from pluto_fleet.crazyflie.session import Worker
from pluto_fleet.drones.protocol import LinkLost
from pluto_fleet.shared.domain.errors import BadInput
from tests.kit.command import python


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


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"camra": "x"}, 'a Crazyflie has no option "camra"; it has measure,'),
        ({"camera": "192.168.4.1"}, "camera must be a host and a port"),
        ({"camera_view": [65]}, "camera_view must be two angles"),
        ({"measure": "bme.temp"}, "measure must be a table"),
        ({"measure": {"dust": "pm25"}}, "measure must be a table of log variables"),
        ({"grip": {"parameter": "a.b", "pick": 1, "release": 0, "x": 1}}, "grip must be a table"),
        ({"decks": [1]}, "decks must be a list of texts"),
        ({"least_voltage": nan}, "least_voltage must be a number"),
        ({"sure_within": 0.0}, "sure_within must be a number of metres above 0"),
        ({"sure_within": 10**400}, "sure_within must be a number of metres above 0"),
        ({"lost_beyond": float("nan")}, "lost_beyond must be a number of metres above 0"),
        ({"lost_beyond": 0.05}, r"lost_beyond must be at least sure_within, which is 0\.07"),
        ({"starts_at_home": 1}, "starts_at_home must be true or false"),
    ],
)
def test_an_option_that_cannot_be_used_is_named(given: dict[str, object], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        options_of(given)


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


@pytest.mark.parametrize(
    ("protocol", "release"),
    [
        (-1, "before 2024.10"),
        (7, "before 2024.10"),
        (9, "2025.02"),
        (10, "2025.09 or 2025.12"),
        (11, "after 2025.12"),
        (12, "2026.04 or 2026.08"),
        (13, "after 2026.08"),
    ],
)
def test_a_firmware_has_the_name_of_its_release(protocol: int, release: str) -> None:
    """As far as its protocol says."""
    assert messages.release(protocol) == release


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
