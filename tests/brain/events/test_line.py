"""Photos along a line: where they are asked for, and what goes on over a restart and an interruption."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.events.company import CompanyOf
from pluto_fleet.shared.events.declared import TRIP_FIELDS
from pluto_fleet.shared.events.raising import EventsOf
from pluto_fleet.shared.events.tracks import TracksOf
from tests.brain.events.test_pursuit import ALONG, Trip
from tests.brain.hand import charged, settled
from tests.kit import apps

LINE = {
    "name": "line",
    "action": "take_photo",
    "source": [2.0, 0.5, 1.2],
    "target": [10.0, 0.5, 1.2],
    "fields": {"along": {"action": "take_photo", "parameters": {}, "metres": 2.0}},
}


def app() -> Any:
    """Return an app that takes photos on the way."""
    made: Any = apps.app(apps.flow()).given
    return replace(
        made,
        trip=Trip,
        fields=(*made.fields, *TRIP_FIELDS, ALONG),
        parts=(EventsOf(), TracksOf(), CompanyOf()),
    )


def asked(brain: Brain, now: float, x: float, z: float = 1.2) -> int:
    """Have the drone be at a place, answer what is asked of it there, and return for how many photos that was."""
    place = {"at": [x, 0.5, z], "battery": 0.9, "landed": z == 0.0}
    brain.tell({"telemetry": {"cf1": place}}, now)
    found = 0
    while photos := [order for order in settled(brain, now) if order["do"] == "act"]:
        found += len(photos)
        for order in photos:
            brain.tell({"done": order["id"]}, now)
    return found


def flying() -> Brain:
    """Return a brain whose drone flies along the line, at 4.2 m, and has taken two photos."""
    brain = charged(app=app(), recorded=True)
    brain.go_on({}, {"cf1": {"reached": True, "landed": True}}, 0.0)
    brain.begin([{"name": "m", "trips": [LINE]}], 0.0)
    settled(brain, 0.0)
    assert asked(brain, 10.0, 1.0, 0.5) == 0
    assert asked(brain, 20.0, 2.0) == 1
    assert asked(brain, 30.0, 3.0) == 0
    assert asked(brain, 40.0, 4.2) == 1
    return brain


def test_what_was_too_far_on_is_made_up_for() -> None:
    """Else a long line would have fewer photos than planned, one for each few that are late."""
    brain = flying()
    assert asked(brain, 50.0, 5.8) == 0
    assert asked(brain, 60.0, 6.0) == 1
    brain.close()


def test_the_line_goes_on_where_it_was_after_a_restart() -> None:
    """Its drone has flown on meanwhile, and has been at the beginning already."""
    brain = flying()
    record = brain.standing()
    brain.close()
    later = charged(app=app(), recorded=True)
    later.restore(record, 45.0)
    later.tell(
        {"telemetry": {"cf1": {"at": [5.0, 0.5, 1.2], "battery": 0.9, "landed": False}}}, 45.0
    )
    later.go_on({"m": {}}, {}, 45.0)
    assert asked(later, 45.0, 5.0) == 0
    assert asked(later, 60.0, 6.3) == 1
    later.close()


def test_a_drone_above_the_beginning_is_at_it() -> None:
    """Others in its way have it fly higher."""
    brain = charged(app=app(), recorded=True)
    brain.go_on({}, {"cf1": {"reached": True, "landed": True}}, 0.0)
    brain.begin([{"name": "m", "trips": [LINE]}], 0.0)
    settled(brain, 0.0)
    assert asked(brain, 10.0, 2.0, 0.4) == 0
    assert asked(brain, 20.0, 2.0, 2.6) == 1
    brain.close()
