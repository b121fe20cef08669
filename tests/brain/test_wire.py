"""All that crosses the seam is plain data: JSON on its way changes nothing."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import pytest

from pluto_fleet.shared import brain
from pluto_fleet.shared.alone import simulate as by_itself
from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.trace import Event
from tests.brain.hand import charged, settled, trip
from tests.kit.apps import MISHAPS, Example, Flown

Data = Mapping[str, Any]


def plain(data: Any) -> Any:
    """Return data as they are after a way over a wire."""
    return json.loads(json.dumps(data))


class Wired(Brain):
    """A brain at the other end of a wire."""

    def __init__(self, app: Any, fleet: Data, **more: Any) -> None:
        super().__init__(app, plain(fleet), **more)

    def begin(self, missions: Sequence[Data], now: float) -> None:
        super().begin(plain(missions), now)

    def tell(self, message: Data, now: float) -> None:
        super().tell(plain(message), now)

    def orders(self) -> list[dict[str, Any]]:
        orders: list[dict[str, Any]] = plain(super().orders())
        return orders

    def events(self) -> list[Event]:
        events: list[Event] = plain(super().events())
        return events

    def standing(self) -> Data:
        standing: Data = plain(super().standing())
        return standing


def through(wired: type[Brain], fly: Callable[[], Any]) -> Any:
    """Fly with another brain in its place."""
    with pytest.MonkeyPatch.context() as patch:
        for module in (brain, by_itself):
            patch.setattr(module, "Brain", wired)
        return fly()


def lines(events: Sequence[Event]) -> list[str]:
    """Return events as they are written."""
    return [json.dumps(event) for event in events]


def test_an_example_flies_over_a_wire_as_without(example: Example) -> None:
    """Each order, message, event, mission, and where all stands at last."""
    fly = partial(example.fly, 0, MISHAPS)
    here: Flown = fly()
    there: Flown = through(Wired, fly)
    assert lines(there.trace) == lines(here.trace)
    assert there.ends == here.ends


MISSION = {"name": "1", "index": 0, "fields": {}}
TRIP = {"name": "1", "index": 0, "fields": {}, "source": None, "parameters": {}, "item": None}
FLEET: Data = {"after_trip": "home", "max_airborne": None, "silent": False, "began": 0.0}
DONE = {"value": None}
FAILED = {"failure": "UNKNOWN", "reason": ""}
NEWS = {"at": [1.0, 0.5, 0.0], "battery": 1.0, "landed": True}


def test_what_is_missing_has_a_default() -> None:
    """Written out or not, it leaves the same orders and events."""

    def flown(given: bool) -> object:
        fleet, mission, a_trip, done, failed, news = (
            one if given else {} for one in (FLEET, MISSION, TRIP, DONE, FAILED, NEWS)
        )
        brain = charged(**fleet)
        trips = [{**trip(3.0), **a_trip}, trip(4.0)]
        brain.begin([{**mission, "trips": trips}], 0.0)
        (one,) = orders = settled(brain, 0.0)
        brain.tell({"done": one["id"], **done, "telemetry": {"cf1": news}}, 5.0)
        (other,) = more = settled(brain, 5.0)
        brain.tell({"failed": other["id"], **failed}, 9.0)
        (recovery,) = last = settled(brain, 9.0)
        brain.tell({"done": recovery["id"], "value": True}, 9.0)
        said = json.dumps([*orders, *more, *last, *brain.events(), brain.standing(), brain.over])
        brain.close()
        return said

    assert flown(True) == flown(False)
