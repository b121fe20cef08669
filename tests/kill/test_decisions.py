"""An action of the app's own that is cut short: a person decides; one that blocks holds up no Stop."""

from __future__ import annotations

import signal
from contextlib import closing
from pathlib import Path

import pytest

from pluto_fleet.journal.reader import Reader
from tests.kill.judge import folded
from tests.kill.lives import Flight, eventually
from tests.kill.painter import painted


def statuses(flight: Flight) -> list[str]:
    with closing(Reader(flight.journal)) as reader:
        records = folded([row.text for row in reader.rows()])
    return [record["status"] for record in records.missions.values()]


def cut_short(flight: Flight) -> None:
    """Kill the app while it does its first action, and let it find out that it cannot be told."""
    begun = flight.folder / "begun"
    flight.start()
    assert eventually(begun.exists)
    flight.kill()
    flight.start()
    assert flight.see_through() == 4
    (flight.folder / "go").touch()


@pytest.mark.parametrize(
    ("answer", "code", "expected"),
    [
        ("done", 0, ["right"]),
        pytest.param("not-done", 0, ["left", "right"], marks=pytest.mark.long),  # the same
        pytest.param("cancel", 1, [], marks=pytest.mark.long),  # flight as far as there
    ],
)
def test_what_was_not_seen_a_person_decides(
    answer: str, code: int, expected: list[str], painting: Flight
) -> None:
    """And it is done once, or once more, or never."""
    cut_short(painting)
    asked = painting.run("decide", str(painting.journal))
    assert asked.returncode == 0
    assert "was spray of trip left done by d0?" in asked.stdout
    assert asked.stdout in painting.lives[-1]
    said = painting.run("decide", str(painting.journal), "wall", answer)
    assert (said.returncode, said.stderr) == (0, "")
    painting.start()
    assert painting.see_through() == code
    assert painted(painting.folder) == expected


def test_a_stop_waits_for_no_hook(painting: Flight) -> None:
    """Not even for one that blocks the whole app: the drones land, and a second Ctrl-C ends it."""
    painting.start()
    begun: Path = painting.folder / "begun"
    (painting.folder / "block").touch()
    assert eventually(begun.exists)
    painting.signal(signal.SIGINT)
    painting.until_it_says("the app is busy: the gateway lands the drones without it")
    painting.signal(signal.SIGINT)
    assert painting.see_through() == 130
    (painting.folder / "block").unlink()
    (painting.folder / "go").touch()
    painting.start()
    assert painting.see_through() == 4
    assert statuses(painting) != ["COMPLETED"]
