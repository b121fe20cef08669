"""The kit with which hooks of an app with events are tested: what a flight refuses, it refuses."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.events.testing import AppKit, KitContext
from tests.brain.events.test_events import Intruder, app_with


@pytest.fixture
def context() -> KitContext:
    return kit().context()


def kit() -> Any:
    """Return a kit of an app with the event `intruder`."""
    return AppKit(app_with())


@pytest.mark.parametrize(
    ("event", "facts", "wrong"),
    [
        ("intrudr", {}, 'there is no event "intrudr"'),
        ("intruder", {"kind": 3}, "kind 3 is not a text"),
        ("intruder", {"colour": "red"}, 'unknown key "colour"'),
        ("intruder", {"at": "Dock"}, "is not a list of 2 or 3 numbers"),
        ("intruder", {"at": (float("nan"), 1.0)}, "at"),
    ],
)
def test_what_cannot_be_raised_is_an_error_as_in_a_flight(
    context: KitContext, event: str, facts: dict[str, Any], wrong: str
) -> None:
    with pytest.raises(ValueError, match=wrong):
        context.emit(event, **facts)
    assert context.emitted == []
    with pytest.raises(ValueError, match=wrong):
        kit().event(event, **facts)


def test_an_event_has_what_it_declares(context: KitContext) -> None:
    event = kit().event("intruder", at=(1.0, 2.0), track="t7", kind="dog")
    assert event == Intruder(
        id="intruder-1", name="intruder", time=0.0, at=(1.0, 2.0, 0.0), track="t7", kind="dog"
    )
    context.emit("intruder", at=(1, 2), kind="dog")
    assert context.emitted == [("intruder", {"at": (1, 2), "kind": "dog"})]
