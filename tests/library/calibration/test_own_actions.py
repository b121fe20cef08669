"""How long actions of an app's own took, beside what plans count with."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from pluto_fleet.__main__ import main
from pluto_fleet.app import App
from pluto_fleet.calibration.commands import Flights, read_flights
from pluto_fleet.calibration.fit import calibrated
from pluto_fleet.journal.header import header
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.shared.domain.actions import Parameter
from pluto_fleet.shared.domain.errors import ActionFailed
from pluto_fleet.shared.domain.model import Drone, Trip
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context
from tests.calibrating.flights import flown
from tests.kit import apps
from tests.kit.command import run
from tests.kit.living import Living, enterable
from tests.paths import ROOT

PAGE = (ROOT / "docs" / "calibration.md").read_text("utf-8")


async def _look(drone: Drone, trip: Trip, context: Context) -> None:
    await context.sleep(42.0 + Random(trip.name).uniform(-1.0, 1.0))


async def _listen(drone: Drone, trip: Trip, context: Context, span: float = 30.0) -> None:
    await context.sleep(span + 3.0 + Random(trip.name).uniform(-0.5, 0.5))


async def _wait(drone: Drone, trip: Trip, context: Context) -> None:
    await context.sleep(10.0)


SPAN = Parameter(name="span", type=Type.TIME, default=30.0)
LOOK = OwnAction(name="look", hook=_look)
LISTEN = OwnAction(name="listen", hook=_listen, takes="span", parameters=(SPAN,))


def trips(action: str, count: int) -> list[apps.Trip]:
    return [apps.trip(str(at), 2.0 + at % 3, action=action) for at in range(count)]


def fly(path: Path, app: App, there: Sequence[apps.Trip]) -> Path:
    lasting = replace(apps.SCOUT, flight_time=100_000.0)  # no battery cuts an action short
    app = apps.changed(app, categories=(lasting,))
    return flown(path, app, apps.fleet(), apps.mission("m", *there))


def notes(*journals: Flights) -> list[str]:
    return calibrated(journals, CRAZYFLIE).notes


def calibrate(words: Sequence[str]) -> int:
    return main(["calibrate", *words])


def test_what_takes_longer_than_plans_count_with_is_told_and_what_to_write(tmp_path: Path) -> None:
    path = fly(tmp_path / "J", enterable(actions=[LOOK]), trips("look", 12))
    (own,) = json.loads(run(calibrate, path, "--json").out)["own_actions"]
    assert (own["app"], own["name"], own["count"]) == ("tested", "look", 12)
    assert (own["planned"], own["parameter"]) == (pytest.approx(5.0), None)
    low, high = own["interval"]
    assert 41.0 < low < own["seconds"] < high < 43.0
    (note,) = notes(read_flights(path))
    seconds, error = f"{own['seconds']:.2f}", f"{(high - low) / 2:.2f}"
    assert note == (
        f"look took {seconds} s ± {error} s in 12 trips, and plans count with 5 s:"
        ' write "takes 42 s" in the app'
    )
    assert f"note: {note}\n" in run(calibrate, path).out
    assert f"note: {note}\n" in PAGE


def test_an_action_with_a_parameter_is_held_to_what_that_says(tmp_path: Path) -> None:
    """Also where a trip leaves it out."""
    there = trips("listen", 12)
    for at, trip in enumerate(there[2:]):
        trip.parameters = {"span": 5.0 * at}
    path = fly(tmp_path / "J", enterable(actions=[LISTEN]), there)
    (own,) = json.loads(run(calibrate, path, "--json").out)["own_actions"]
    planned = (30.0 + 30.0 + sum(5.0 * at for at in range(10))) / 12
    assert (own["planned"], own["parameter"]) == (pytest.approx(planned), "span")
    assert own["seconds"] == pytest.approx(planned + 3.0, abs=0.5)
    (note,) = notes(read_flights(path))
    assert note.startswith("listen took ")
    assert note.endswith(
        ' s longer than its parameter "span" says, on average of 12 trips,'
        " and plans count with what that says"
    )
    assert f"note: {note}\n" in PAGE


@pytest.mark.parametrize("takes", [42.0, 42.3])
def test_what_takes_what_plans_count_with_is_in_no_note(tmp_path: Path, takes: float) -> None:
    """Nor is what differs by less than one would write into an app."""
    look = OwnAction(name="look", hook=_look, takes=takes)
    path = fly(tmp_path / "J", enterable(actions=[look]), trips("look", 12))
    what = calibrated([read_flights(path)], CRAZYFLIE)
    assert (what.notes, [own.count for own in what.own]) == ([], [12])


def test_two_trips_are_too_few(tmp_path: Path) -> None:
    path = fly(tmp_path / "J", enterable(actions=[LOOK]), trips("look", 2))
    what = calibrated([read_flights(path)], CRAZYFLIE)
    assert (what.notes, what.own) == ([], [])


def test_plans_count_with_what_the_newest_journal_says(tmp_path: Path) -> None:
    """And the trips of all count."""
    before = read_flights(fly(tmp_path / "J", enterable(actions=[LOOK]), trips("look", 6)))
    look = OwnAction(name="look", hook=_look, takes=42.0)
    after = read_flights(fly(tmp_path / "K", enterable(actions=[look]), trips("look", 2)))
    assert after.begun > before.begun > 0.0
    for journals in ([before, after], [after, before]):
        what = calibrated(journals, CRAZYFLIE)
        assert (what.notes, [own.count for own in what.own]) == ([], [8])
    (note,) = notes(before)
    assert 'write "takes 42 s"' in note


def test_actions_of_two_apps_are_not_the_same_if_they_are_called_so(tmp_path: Path) -> None:
    one = enterable(actions=[LOOK])
    other = apps.changed(enterable(actions=[OwnAction(name="look", hook=_wait)]), name="other")
    journals = [
        read_flights(fly(tmp_path / app.name, app, trips("look", 5))) for app in (one, other)
    ]
    first, second = notes(*journals)
    assert first.startswith("look of other took 10.00 s ± 0.00 s in 5 trips")
    assert second.startswith("look of tested took ")


def test_what_failed_was_broken_off_or_seen_only_afterwards_does_not_count(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The hook says of a trip that is paused, and of one in which the app dies, that its action was done."""
    monkeypatch.setattr(sys.modules[__name__], "wait_done", lambda *_: True, raising=False)
    mishaps: dict[str, Callable[[], object]] = {
        "0": lambda: living.life.control.pause("m"),
        "1": lambda: living.crash(living.kernel.now + 0.1, down=50.0),
        "cancelled": lambda: living.life.control.cancel("n"),
    }

    async def wait(drone: Drone, trip: Trip, context: Context) -> None:
        if (mishap := mishaps.pop(trip.name, None)) is not None:
            living.at(living.kernel.now + 3.0, mishap)
        await context.sleep(10.0)
        if trip.name == "2" and trip.attempt == 1:
            raise ActionFailed("it is dark")

    app = enterable(actions=[OwnAction(name="wait", hook=wait)], attempts=3)
    there = [apps.mission("m", *trips("wait", 8))]
    there.append(apps.mission("n", apps.trip("cancelled", 5.0, action="wait")))
    living = Living(app, *there)
    living.at(200.0, lambda: living.life.control.go_on("m"))
    assert living.run() == ["COMPLETED", "CANCELLED"]
    assert [len(living.named(f"trip.{how}")) for how in ("completed", "failed")] == [8, 2]
    told = header(app, missions="", fleet=None, sim=True, seed=0)
    with closing(Store.create(tmp_path / "J", told)) as store:
        store.append([Entry(json.dumps([event])) for event in living.memory.events])
    (own,) = calibrated([read_flights(tmp_path / "J")], CRAZYFLIE).own
    assert own.count == 6
    assert own.seconds == pytest.approx(10.0)
