"""What `simulate` prints, and how it ends."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.shared.alone.world import FAULTS, Faults
from tests.kit import apps
from tests.library.cli.conftest import Command
from tests.library.files.an_app import APP, POLLINATE


def with_pollinate(hook: Any) -> App:
    """Return the app with another hook for its action."""
    return apps.changed(APP, actions={**APP.actions, "pollinate": replace(POLLINATE, hook=hook)})


def test_the_same_seed_gives_the_same_text(missions: Path, command: Command) -> None:
    """Byte for byte, with faults too; another seed gives another."""
    flags = ("simulate", missions, "--json", "--fail", "crash=40%", "--seed")
    first, again, other = command(*flags, 1), command(*flags, 1), command(*flags, 3)
    assert first == again
    assert first[1].replace('"seed": 1', '"seed": 3') != other[1]


@pytest.mark.process
def test_many_runs_have_a_summary(missions: Path, command: Command) -> None:
    """Each run is the object of one, and the summary tells what they share."""
    flags = ("simulate", missions, "--runs", 4, "--seed", 10, "--fail", "crash=30%")
    code, out, _ = command(*flags, "--json")
    data = json.loads(out)
    assert list(data) == ["app", "seed", "runs", "summary"]
    assert [run["seed"] for run in data["runs"]] == [10, 11, 12, 13]
    single = json.loads(command("simulate", missions, "--json", *flags[4:])[1])
    assert data["runs"][0] == single
    bad = [
        run["seed"]
        for run in data["runs"]
        if any(mission["status"] == "FAILED" for mission in run["missions"])
    ]
    assert data["summary"]["failed_seeds"] == bad
    assert code == (1 if bad else 0)
    text = command(*flags)[1]
    assert text.startswith("seed 10: ")
    assert text.count("\nseed 1") == 3
    assert f"\n\n{4 - len(bad)} of 4 runs succeeded" in text


def interrupt(*_: object, **__: object) -> None:
    raise KeyboardInterrupt


def test_an_interrupt_is_exit_130_and_leaves_no_half_trace(
    missions: Path, command: Command, tmp_path: Path
) -> None:
    """An earlier trace stays as it was."""
    trace = tmp_path / "t"
    trace.write_text("old")
    app = with_pollinate(interrupt)
    code, _, err = command("simulate", missions, "--trace", trace, app=app)
    assert (code, err) == (130, "alfalfa: interrupted\n")
    assert trace.read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["m.toml", "t"]


def shouts(drone: Any, trip: Any, context: Any, **_: object) -> None:
    context.log("red \x1b[31m\nand a second line")


def test_a_hooks_text_cannot_command_the_terminal(missions: Path, command: Command) -> None:
    """It is shown escaped, its further lines indented; JSON keeps it as it was."""
    app = with_pollinate(shouts)
    out = command("simulate", missions, app=app)[1]
    assert "s  North: red \\x1b[31m\n" + " " * 12 + "and a second line\n" in out
    data = json.loads(command("simulate", missions, "--json", app=app)[1])
    assert data["log"] == ["red \x1b[31m\nand a second line"]


async def broken(run: Any) -> Any:
    return 1 // 0


def test_a_mistake_of_ours_is_exit_70(
    missions: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A short message; where it happened only on request."""
    app = apps.changed(APP, flow=broken)
    monkeypatch.delenv("PLUTO_DEBUG", raising=False)
    code, _, err = command("simulate", missions, app=app)
    assert code == 70
    assert err == (
        "alfalfa: internal error: ZeroDivisionError: integer division or modulo by zero\n"
        "This is a mistake of ours: please report it (PLUTO_DEBUG=1 shows where it happened).\n"
    )
    monkeypatch.setenv("PLUTO_DEBUG", "1")
    assert "in broken\n    return 1 // 0" in command("simulate", missions, app=app)[2]


async def broken_in_a_block(run: Any) -> Any:
    error = ZeroDivisionError("by accident")
    error.add_note("in block scan = survey.GridScan")
    raise error


def test_a_mistake_in_a_block_names_the_block(missions: Path, command: Command) -> None:
    """As its declaration has it: it may be another author's."""
    err = command("simulate", missions, app=apps.changed(APP, flow=broken_in_a_block))[2]
    assert err == (
        "alfalfa: internal error: ZeroDivisionError: by accident\n"
        "in block scan = survey.GridScan\n"
        "This is a mistake of ours, or of that block's author: please report it "
        "(PLUTO_DEBUG=1 shows where it happened).\n"
    )


def test_every_fault_of_the_simulation_can_be_asked_for(missions: Path, command: Command) -> None:
    """By its own name, in their order."""
    assert tuple(Faults.__dataclass_fields__) == FAULTS
    every = ",".join(f"{what}=0.1%" for what in FAULTS)
    assert command("simulate", missions, "--fail", every)[0] in (0, 1)
