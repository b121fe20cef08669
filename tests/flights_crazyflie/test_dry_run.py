"""What a dry run prints is what a Crazyflie is told."""

from __future__ import annotations

import os
import re
import subprocess
import sys

from tests.flights_crazyflie.conftest import NewFlight
from tests.flights_crazyflie.flight import Flight
from tests.flights_crazyflie.plans import fleet

MISSIONS = """
[[mission]]
[[mission.trip]]
action = "take_photo"
target = [0.8, 0.6, 0.6]
"""

COMMAND = re.compile(r" *[\d.]+ s +cf1 +(take off|go to|land) +\((.*?)\)")
CALLED = {"takeoff": "take off", "go_to": "go to", "land": "land"}


def printed(flight: Flight) -> list[tuple[str, list[float]]]:
    """Return what a dry run says that the drone would be told, and where."""
    files = ["missions.toml", "--fleet", "fleet.toml"]
    done = subprocess.run(
        [sys.executable, "-m", flight.app, "fly", *files, "--dry-run", "--crtp-sim", "1"],
        cwd=flight.folder,
        env={**os.environ, "PYTHONPATH": str(flight.source)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    found = map(COMMAND.match, done.stdout.splitlines())
    return [
        (line[1], [float(along) for along in line[2].split(", ")])
        for line in found
        if line is not None
    ]


def test_a_dry_run_says_what_a_drone_is_told(new_flight: NewFlight) -> None:
    """The same commands, in the same order, to the same places."""
    flight = new_flight(MISSIONS, fleet(1), 1)
    meant = printed(flight)
    flight.start()
    assert flight.see_through() == 0, flight.told
    told = [command for command in flight.commands if command.what in CALLED]
    assert [CALLED[command.what] for command in told] == [what for what, _ in meant]
    for command, (what, place) in zip(told, meant, strict=True):
        wanted = [command.values.get(axis, at) for axis, at in zip("xyz", command.at, strict=True)]
        assert all(abs(a - b) < 0.1 for a, b in zip(wanted, place, strict=True)), (what, command)
