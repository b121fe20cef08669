"""What `simulate --runs` says of many runs, and the picture that it draws of them."""

from __future__ import annotations

import os
import signal
import sys
from dataclasses import replace
from pathlib import Path
from shlex import split
from typing import Any

import pytest

from pluto_fleet.cli import runs
from pluto_fleet.cli.runs import run_of
from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.trials.drone_rules import Items
from tests.library.cli.conftest import Command
from tests.library.cli.test_simulate import with_pollinate

pytestmark = pytest.mark.process
CRASHES = ("--fail", "crash=30%", "--seed", 10)


def twice(seed: int, outcome: SimulationResult, items: Items) -> Any:
    """Let the mission that ended last end once more."""
    end: Event = next(
        event for event in reversed(outcome.events) if event["event"] == "mission.ended"
    )
    return run_of(seed, replace(outcome, events=(*outcome.events, end)), items)


@pytest.mark.long
def test_a_run_that_does_what_no_run_may_do_is_exit_70(
    missions: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It says what, with which seed, and how to see it again."""
    monkeypatch.setattr(runs, "run_of", twice)
    code, out, _ = command("simulate", missions, "--runs", 2, "--fail", "crash=5%", "--seed", 3)
    assert code == 70
    assert "seed 3 did what no run may do: North ended 2 times\n" in out
    again = f"alfalfa simulate {missions} --seed 3 --fail crash=0.05 --trace trace.jsonl\n"
    assert f"See it again: {again}" in out
    spaced = missions.with_name("what's to fly.toml")
    spaced.write_text(missions.read_text())
    when = ["--start", "7:45:00", "--date", "2027-03-28", "--zone", "UTC"]
    _, out, _ = command("simulate", spaced, "--runs", 1, "--until", "2 h", *when)
    (again,) = (line for line in out.splitlines() if line.startswith("See it again: "))
    words = split(again.removeprefix("See it again: "))
    flags = ["--seed", "0", "--until", "7200", *when, "--trace", "trace.jsonl"]
    assert words[2:] == [str(spaced), *flags]


@pytest.mark.long
def test_without_matplotlib_nothing_flies(
    missions: Path, command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Exit 2, and the line that mends it."""
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "pluto_fleet.cli.plot", raising=False)
    code, out, err = command("simulate", missions, "--runs", 2, "--plot", tmp_path / "p.svg")
    assert (code, out) == (2, "")
    assert err.endswith('pip install "matplotlib>=3.8"\n')


def counts(state: list[int]) -> Any:
    """Return a hook that keeps how often it was called, and prints it."""

    async def hook(drone: Any, trip: Any, context: Any, **_: object) -> None:
        state.append(len(state))
        print(f"call {len(state)}")
        context.log(f"call {len(state)} by {drone.id}")

    return hook


@pytest.mark.parametrize("flags", [(), pytest.param(("--json",), marks=pytest.mark.long)])
def test_the_output_is_the_same_for_any_number_of_jobs(
    missions: Path, command: Command, flags: tuple[str, ...]
) -> None:
    """Even of hooks that print, and keep something from run to run."""
    state: list[int] = []
    app = with_pollinate(counts(state))
    said = [
        command("simulate", missions, "--runs", 40, *CRASHES, *flags, "--jobs", jobs, app=app)
        for jobs in (1, 3)
    ]
    assert said[0] == said[1]
    assert "call 2" in said[0][1]
    assert state == []  # they were other processes


def killed(*_: object, **__: object) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.long
def test_a_run_that_is_killed_is_told_with_its_seed(missions: Path, command: Command) -> None:
    """In a sentence, after what has been flown."""
    code, _, err = command(
        "simulate", missions, "--runs", 3, "--seed", 7, app=with_pollinate(killed)
    )
    assert code == 2
    assert err == (
        "alfalfa: the process that flew seed 7 was killed by SIGKILL: fewer of them need less memory"
        " (--jobs 1); if it is always this seed, something in hooks.py ends it\n"
    )


def interrupts(*_: object, **__: object) -> None:
    os.kill(os.getppid(), signal.SIGINT)
    while True:
        signal.pause()


@pytest.mark.long
@pytest.mark.usefixtures("no_worker_left")
def test_an_interrupt_ends_all_runs_at_once(missions: Path, command: Command) -> None:
    """With hooks that are busy in them."""
    code, _, err = command("simulate", missions, "--runs", 3, app=with_pollinate(interrupts))
    assert (code, err) == (130, "alfalfa: interrupted\n")
