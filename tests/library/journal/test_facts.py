"""Rows, as they are read again."""

from __future__ import annotations

import json

import pytest

from pluto_fleet.journal.facts import row_of


def test_an_event_keeps_the_fields_that_its_app_declares() -> None:
    event = {
        "id": "a",
        "name": "smoke",
        "time": 1.0,
        "at": [3.0, 4.0, 1.2],
        "level": 0.9,
        "colour": "grey",
    }
    row = {"event": event, "open": ["look_there"]}
    assert row_of("happening", ("a",), json.dumps(row)) == row


def test_an_event_without_what_every_event_has_is_refused() -> None:
    with pytest.raises(ValueError, match="the row of happening a is not as this version knows it"):
        row_of("happening", ("a",), json.dumps({"event": {"id": "a"}, "open": []}))
