"""Stations of examples that were compiled a moment ago, without a browser."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.kit.apps import EXAMPLES, compiled, fly_straight
from tests.kit.station import App, Station

Serve = Callable[..., Station]


def program_of(name: str, folder: Path) -> App:
    """Compile an example, and make a program of it that runs where it was compiled."""
    package = compiled(name, folder)
    program = folder / f"{name}.sh"
    path = f"PYTHONPATH='{package / 'src'}'"
    program.write_text(f"#!/bin/sh\n{path} exec '{sys.executable}' -m {name} \"$@\"\n")
    program.chmod(0o755)
    files = folder / "files" / name
    shutil.copytree(EXAMPLES / name, files)
    fly_straight(files / "fleet.toml")
    return App(
        name=name,
        program=program,
        fleet=files / "fleet.toml",
        missions=files / "missions.toml",
    )


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], App]:
    """Compile each example that is asked for, once."""
    folder, known = tmp_path_factory.mktemp("apps"), dict[str, App]()

    def program(name: str) -> App:
        if name not in known:
            known[name] = program_of(name, folder)
        return known[name]

    return program


@pytest.fixture
def serve(programs: Callable[[str], App], tmp_path: Path) -> Iterator[Serve]:
    """Start stations with the missions of their examples; leave no process behind."""
    stations: list[Station] = []

    def serve(name: str = "drugs_distribution", *options: str) -> Station:
        app, folder = programs(name), tmp_path / f"station{len(stations)}"
        folder.mkdir(exist_ok=True)
        at_its_own = "--speed" in options or "--crtp-sim" in options
        speed = () if at_its_own else ("--speed", "30")
        options = ("--missions", os.fspath(app.missions), *speed, *options)
        station = Station(app=app, folder=folder, options=options)
        stations.append(station)
        station.start()
        return station

    yield serve
    for station in stations:
        station.end()
