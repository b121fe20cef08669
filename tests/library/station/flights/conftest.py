"""Stations of examples: in this process, and a few as processes of their own."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.kit.station import Station, compiled_app
from tests.library.station.in_process import Flown, world

Serve = Callable[..., Flown]
Run = Callable[..., Station]


@pytest.fixture
def serve(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Serve]:
    """Serve stations of examples, with the missions of these."""
    with world(monkeypatch) as here:

        def serve(
            name: str = "drugs_distribution", folder: str = "station", **options: object
        ) -> Flown:
            return Flown(world=here, name=name, folder=tmp_path / folder, options=options)

        yield serve


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Run]:
    """Run stations as processes; leave none behind."""
    stations: list[Station] = []

    def run(*options: str, name: str = "drugs_distribution") -> Station:
        app = compiled_app(name, tmp_path / "apps")
        folder = tmp_path / f"station{len(stations)}"
        folder.mkdir(exist_ok=True)
        speed = () if {"--speed", "--crtp-sim"} & {*options} else ("--speed", "30")
        options = ("--missions", os.fspath(app.missions), *speed, *options)
        stations.append(Station(app=app, folder=folder, options=options))
        stations[-1].start()
        return stations[-1]

    yield run
    for station in stations:
        station.end()
