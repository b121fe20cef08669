"""How `fly` ends."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from plutoc_runtime.airspace import Airspace
from plutoc_runtime.cli import fly
from plutoc_runtime.cli.plans import Plan
from plutoc_runtime.files.fleet import default_fleet
from plutoc_runtime.files.missions import load_missions
from plutoc_runtime.session import Outcome
from plutoc_runtime.status import Status
from tests.runtime.cli.conftest import Command
from tests.runtime.files.an_app import APP


def plan(missions: Path) -> Plan:
    return Plan(missions=load_missions(missions, APP, Airspace()), fleet=default_fleet(APP))


def test_whoever_cancels_a_flight_waits_for_the_landing(
    missions: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And is told what goes on."""
    landed = []

    async def flying(*_: object, **__: object) -> None:
        try:
            await asyncio.Event().wait()
        finally:
            await asyncio.sleep(0)
            landed.append(True)

    async def scenario() -> None:
        task = asyncio.ensure_future(fly.flown(APP, plan(missions)))
        await asyncio.sleep(0)
        await asyncio.sleep(0)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task

    monkeypatch.setattr(fly, "fly_simulated", flying)
    asyncio.run(scenario())
    assert landed == [True]
    assert capsys.readouterr().err.split("\n")[:2] == [
        "stopping: the drones land where they are (once more to leave at once)",
        "all drones have landed",
    ]


@pytest.mark.parametrize(
    ("status", "code"),
    [
        (Status.COMPLETED, 0),
        (Status.FAILED, 1),
        (Status.UNCERTAIN, 4),
    ],
)
def test_the_exit_code_tells_how_the_missions_stand(
    missions: Path,
    command: Command,
    monkeypatch: pytest.MonkeyPatch,
    status: Status,
    code: int,
) -> None:
    """Completed, failed, or waiting for a person."""

    async def flying(app: Any, missions: Any, fleet: Any, *, on_event: Any, **_: Any) -> Outcome:
        on_event({"t": 1.0, "event": "log", "mission": "North", "text": "hello"})
        for mission in missions:
            mission.status = status
        return Outcome(duration=3.0, missions=tuple(missions), drones=(), flown={}, events=())

    monkeypatch.setattr(fly, "fly_simulated", flying)
    fleet = missions.with_name("f.toml")
    drones = (f'id = "{name}"\ncategory = "{name}"\nhome = [{x}, 1]'
              for x, name in enumerate(("scout", "carrier"), 1))  # fmt: skip
    fleet.write_text("\n".join(f"[[drone]]\n{drone}" for drone in drones))
    ended, out, err = command("fly", missions, "--fleet", fleet, "--sim")
    assert (ended, err) == (code, "")
    assert out.startswith("     1.0 s  North: hello\n\nmission  status")
