"""What all pages see goes on, though something of it cannot be shown."""

from __future__ import annotations

import pytest

from pluto_fleet.station.session import FlightSession

from .conftest import Serve


def test_a_mistake_in_what_is_shown_leaves_no_page_waiting_and_the_flight_flies_on(
    serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    station, complaints = serve().flying(), list[object]()
    station.world.loop.set_exception_handler(lambda _, about: complaints.append(about))
    with monkeypatch.context() as wrong:
        wrong.setattr(FlightSession, "look", lambda *_: 1 / 0)
        assert station.now()["state"]["phase"] == "flying"
        station.comes_to("over")
    assert complaints
    station.completes_all_once()
