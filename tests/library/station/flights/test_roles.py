"""A station that others may reach prints two addresses: for those who fly, and for those who watch."""

from __future__ import annotations

import re

import pytest

from pluto_fleet.client import Refused
from pluto_fleet.client import Station as Client
from tests.library.station.flights.conftest import Serve
from tests.library.station.flights.test_flights import comes_to, events

WATCH = re.compile(r"^to watch only: (http://\S+)", re.MULTILINE)


def test_who_watches_sees_what_is_flown_and_by_whom_and_commands_nothing(serve: Serve) -> None:
    station = serve("drugs_distribution", "--name", "ward.example")
    [address] = WATCH.findall(station.said())
    flies, watches = Client(station.url, who="Zübeyde"), Client(address, who="Ben")
    assert (flies.app()["role"], watches.app()["role"]) == ("fly", "watch")
    flies.start()
    with pytest.raises(Refused, match="may watch and not command") as refused:
        watches.stop(how="land")
    assert refused.value.status == 403
    assert watches.live()["state"]["phase"] == "flying"
    flies.stop(how="land")
    comes_to(station, "stopped")
    assert "Zübeyde" in [line.get("by") for line in station.audit()]
    assert [begun["by"] for begun in events(station, "journal.begun")] == ["Zübeyde"]
    station.kill()
    station.start()
    assert WATCH.findall(station.said()) == [address]
    with pytest.raises(Refused, match="this needs the token"):
        Client(f"http://127.0.0.1:{station.port}").plan()
