"""What nothing bounds ends in a simulation all the same, and says why."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from pluto_fleet.shared.alone import simulate as enough
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.run import Run
from plutoc_blocks.mission_creator.step import create_mission
from tests.kit import apps
from tests.library.cli.conftest import Command
from tests.library.files.an_app import APP, FieldMission
from tests.trials.examples import WAITING, app_of

WHY = 'mission "South" has set out 100 times for 1 trip, and nothing ends that; to fly on, say how'


async def rests(run: Run[FieldMission]) -> Status:
    """Do nothing at all, an hour after the other."""
    create_mission(run, Status.UNEXECUTED)
    while True:
        await run.core.kernel.sleep(3_600.0)


UNBOUNDED = apps.changed(APP, flow=apps.flow(attempts=0))
"""It flies each trip until it is done: there is no bound."""
NEVER = ("--fail", "action=100%")


@pytest.fixture(autouse=True)
def _soon(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A thousand flights say no more than a hundred do."""
    monkeypatch.setattr(enough, "FLIGHTS", 100)
    yield


def test_a_trip_that_never_succeeds_is_given_up(missions: Path, command: Command) -> None:
    """With a reason, the bound, and what to do; the report comes all the same."""
    code, out, err = command("simulate", missions, *NEVER, app=UNBOUNDED)
    assert (code, err) == (1, "")
    *_, why, last, _ = out.splitlines()
    assert why.startswith(f"given up: {WHY} long with --until")
    assert last.startswith("0 of 2 missions completed, 2 not finished in ")


def test_a_program_is_told_so_too(missions: Path, command: Command) -> None:
    """And nothing of it where a simulation has come to its end."""
    code, out, err = command("simulate", missions, *NEVER, "--json", app=UNBOUNDED)
    assert (code, err) == (1, "")
    assert json.loads(out)["given_up"].startswith(WHY)
    assert "given_up" not in json.loads(command("simulate", missions, "--json")[1])


def test_who_says_how_long_is_obeyed(missions: Path, command: Command) -> None:
    """However often something sets out until then, and a mission that `--until` cuts has not failed."""
    flags = ("--until", "3 h", *NEVER)
    code, out, _ = command("simulate", missions, *flags, app=UNBOUNDED)
    assert code == 0
    assert "given up" not in out
    assert "2 not finished in 3 h" in out


def test_a_round_counts_anew(tmp_path: Path, command: Command) -> None:
    """A mission that is to be repeated 150 times sets out more often than that, and is completed."""
    (tmp_path / "m.toml").write_text(
        '[[mission]]\nname = "M"\nrepeat = 150\n'
        '[[mission.trip]]\naction = "measure"\ntarget = [2, 3]\n'
    )
    code, out, _ = command("simulate", tmp_path / "m.toml")
    assert code == 0
    assert "1 of 1 mission completed" in out


def test_rounds_that_were_not_planned_do_not_count_anew(tmp_path: Path, command: Command) -> None:
    """A hook that asks for one more round, each time, is no bound."""

    def one_more(mission: FieldMission, context: object) -> None:
        mission.repeat += 1

    flow = apps.flow(repeater=True, prepare=one_more)
    (tmp_path / "m.toml").write_text(
        '[[mission]]\nname = "South"\nrepeat = 2\n'
        '[[mission.trip]]\naction = "measure"\ntarget = [2, 3]\n'
    )
    code, out, _ = command("simulate", tmp_path / "m.toml", app=apps.changed(APP, flow=flow))
    assert code == 1
    assert f"given up: {WHY}" in out


def test_missions_that_only_rest_are_given_up(missions: Path, command: Command) -> None:
    """They fly nowhere, and end nowhere."""
    code, out, _ = command("simulate", missions, app=apps.changed(APP, flow=rests))
    assert code == 1
    assert "given up: nothing has set out for 366 days, and missions are not at their end" in out


def test_crashed_drones_are_counted(missions: Path, command: Command) -> None:
    """For programs; not where none has crashed."""
    crash = ("--fail", "crash=100%")
    said = json.loads(command("simulate", missions, *crash, "--json")[1])
    assert said["crashed_drones"] == sum(one["status"] == "LOST" for one in said["drones"]) == 3
    assert "crashed" not in command("simulate", missions)[1]


WAITS = app_of(WAITING)


def test_who_is_to_wait_for_years_does_so(tmp_path: Path, command: Command) -> None:
    """A plan may say so: nothing that is planned is given up."""
    (tmp_path / "m.toml").write_text(
        '[[mission]]\n[[mission.trip]]\naction = "measure"\ntarget = [2, 3]\ndelay = 80_000_000\n'
    )
    code, out, _ = command("simulate", tmp_path / "m.toml", app=WAITS)
    assert code == 0
    assert "1 of 1 mission completed" in out
