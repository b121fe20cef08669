"""Today's library serves packages of the oldest and the newest seam: plan, flights, their hooks' words."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from pluto_fleet.seam import NEWEST, written
from tests.library.station.browser.installed import App
from tests.library.station.browser.serving import Station, until
from tests.seam.packages import (
    SEAMS,
    SOURCES,
    WATCHED,
    WITH_HOOKS,
    Kept,
    environment,
    imported,
    unpacked,
)

POURS = "pours on"


@pytest.fixture(params=[SEAMS[0], SEAMS[-1]])
def station(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Station]:
    """The station of the package with hooks; none of its processes is left behind."""
    package = unpacked(Kept(request.param, WITH_HOOKS), tmp_path)
    monkeypatch.setenv("PLUTO_IMPORTS", environment(package)["PLUTO_IMPORTS"])
    program = tmp_path / "program"
    watch, path = str(WATCHED / "sitecustomize.py"), [str(package / "src"), *sys.path]
    program.write_text(
        f"#!{sys.executable}\nimport runpy, sys\n"
        f"runpy.run_path({watch!r})\nsys.path[:] = {path!r}\n"
        f"from {WITH_HOOKS}.__main__ import main\nsys.exit(main())\n",
        encoding="utf-8",
    )
    program.chmod(0o700)
    source = SOURCES[WITH_HOOKS]
    files = {"fleet": source / "fleet.toml", "missions": source / "missions.toml"}
    app = App(name=WITH_HOOKS, program=program, **files)
    options = ("--speed", "20", "--missions", str(files["missions"]))
    station = Station(app=app, folder=tmp_path / "kept", options=options)
    try:
        station.start()
        yield station
    finally:
        station.end()
    if request.param == written(NEWEST):
        assert imported(package) == {f"pluto_fleet.app {WITH_HOOKS}._runtime.brain"}


def test_it_is_planned_flown_stopped_and_gone_on_with(station: Station) -> None:
    described = station.get("/api/app")
    assert described["name"] == WITH_HOOKS
    assert described["evaluators"] == ["dry_beds"]
    assert [one["name"] for one in described["actions"]] == ["take_photo", "water"]
    assert len(described["graph"]["blocks"]) == 10

    plan = station.get("/api/plan")
    _, south = plan["missions"]
    given = {"revision": plan["revision"], "missions": [{**south, "name": "Beans alone"}]}
    status, plan = station.put("/api/plan", given)
    assert (status, [one["name"] for one in plan["missions"]]) == (200, ["Beans alone"])
    assert plan["problems"] == []

    start = {"id": "1", "revision": plan["revision"], "missions": None}
    assert station.post("/api/start", start)[0] == 200
    until(lambda: _says(station, POURS), "it pours")
    assert station.statuses() == {"Beans alone": "RUNNING"}
    assert station.post("/api/stop", {"id": "2", "how": "land"})[0] == 200
    until(lambda: station.phase == "stopped", lambda: f"it is stopped: {station.now()}")

    assert station.post("/api/resume", {"id": "3"})[0] == 200
    until(
        lambda: "UNCERTAIN" in station.statuses().values(),
        lambda: f"a person is asked: {station.now()}",
    )
    decision: dict[str, object] = {"id": "4", "mission": "Beans alone", "answer": "not-done"}
    assert station.post("/api/decide", decision)[0] == 200
    until(
        lambda: station.statuses() == {"Beans alone": "COMPLETED"},
        lambda: f"it is flown to its end: {station.now()}",
    )
    assert _says(station, "looked at 0, watered 1")
    results = station.get("/api/results.json")
    assert [one["trip"] for one in results if one["trip"]] == ["beans", "water beans"]


def _says(station: Station, what: str) -> bool:
    return any(what in str(line) for line in station.now()["log"])
