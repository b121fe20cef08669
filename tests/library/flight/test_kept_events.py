"""Events that are raised while everything is stopped: told at Resume, or dropped, and never lost or doubled."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import pytest

from pluto_fleet.app import App, described
from pluto_fleet.flight import kept_events
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.events.company import CompanyOf
from pluto_fleet.shared.events.tracks import TracksOf
from tests.brain.events.test_events import app_with
from tests.kit import apps
from tests.kit.living import Living, names


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The computer's clock, set by a test."""
    seconds = [1_000.0]
    monkeypatch.setattr(kept_events, "time", lambda: seconds[0])
    return seconds


def app() -> App:
    """Return an app whose creator makes a mission of each `intruder`."""
    made = app_with()
    return described(replace(made, parts=(*made.parts, TracksOf(), CompanyOf())))


def stopped(clock: list[float], *raised: dict[str, Any], rest: float) -> Living:
    """Stop a flight, raise events while it stands, and resume it; return what came of that."""
    living = Living(app(), apps.mission("a", apps.trip("1", 9)))

    def raise_all() -> None:
        for facts in raised:
            living.life.control.raise_event("intruder", facts)

    def pass_time() -> None:
        clock[0] += rest

    living.stop(2.0)
    living.at(2.5, raise_all)
    living.at(2.6, pass_time)
    living.run()
    return living


def test_what_happens_after_a_stop_is_told_at_resume(clock: list[float]) -> None:
    living = stopped(clock, {"id": "door", "at": [4.0, 2.0]}, {"id": "door"}, rest=50.0)
    assert names(living.named("event.kept"), "id") == ["door"]
    assert names(living.named("event.raised"), "id") == ["door"]
    assert living.statuses == ["COMPLETED", "COMPLETED"]
    assert living.memory.standing().kept == []


def test_what_is_too_old_by_then_is_dropped_and_said_so(clock: list[float]) -> None:
    short = {"id": "door", "at": [4.0, 2.0], "keep": 20.0}
    living = stopped(clock, short, {"id": "roof", "at": [4.0, 2.0], "keep": 600.0}, rest=50.0)
    assert names(living.named("event.dropped"), "why") == [
        "it was raised 50 s ago, and kept for 20 s"
    ]
    assert names(living.named("event.raised"), "id") == ["roof"]


def test_what_cannot_happen_is_not_kept(clock: list[float]) -> None:
    living = Living(app(), apps.mission("a", apps.trip("1", 9)))
    keep = partial(kept_events.kept_one, living.app, living.fleet)
    standing = living.memory.standing()
    with pytest.raises(BadInput, match='there is no event "smoke"; there are: intruder'):
        keep(standing, "smoke", {})
    with pytest.raises(BadInput, match="is outside the map"):
        keep(standing, "intruder", {"at": [4_000.0, 2.0]})
    with pytest.raises(BadInput, match="unknown key"):
        keep(standing, "intruder", {"fields": {"colour": "red"}})
    living.run()
    with pytest.raises(BadInput, match="the flight is over"):
        keep(living.memory.standing(), "intruder", {})
