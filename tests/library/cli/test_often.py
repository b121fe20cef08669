"""What `simulate --runs` says of many runs, and the picture that it draws of them."""

from __future__ import annotations

import json
import os
import signal
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from shlex import split
from typing import Any

import pytest

from pluto_fleet.cli import runs
from pluto_fleet.cli.runs import percentile, run_of
from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.trials.invariants import Items
from tests.library.cli.conftest import Command
from tests.library.cli.test_simulate import with_pollinate

pytestmark = pytest.mark.process
CRASHES = ("--fail", "crash=30%", "--seed", 10)


@pytest.mark.long
def test_few_runs_say_that_they_are_few(missions: Path, command: Command) -> None:
    """And a single one has no percentiles at all."""
    few = command("simulate", missions, "--runs", 3, *CRASHES)[1]
    assert "Of 3 runs, p5 and p95 say little: fly 20 or more." in few
    assert "p95" not in command("simulate", missions, "--runs", 1)[1]


@pytest.mark.long
def test_a_program_gets_percentiles_and_violations(missions: Path, command: Command) -> None:
    """Beside what the summary had before."""
    out = command("simulate", missions, "--runs", 6, *CRASHES, "--json")[1]
    figures = json.loads(out)["summary"]
    assert list(figures) == [
        "runs",
        "succeeded",
        "success_rate",
        "completed_missions",
        "makespan_s",
        "attempts",
        "failed_trips",
        "battery_level",
        "failed_seeds",
        "violations",
    ]
    assert figures["violations"] == []
    assert 0 < figures["battery_level"]["p5"] <= figures["battery_level"]["p95"] < 1


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
    _, out, _ = command("simulate", spaced, "--runs", 1, "--until", "2 h")
    (again,) = (line for line in out.splitlines() if line.startswith("See it again: "))
    words = split(again.removeprefix("See it again: "))
    assert words[2:] == [str(spaced), "--seed", "0", "--until", "7200", "--trace", "trace.jsonl"]


def test_a_percentile_lies_between_two_neighbours() -> None:
    """As far on the way as the share says."""
    numbers: Sequence[float] = (0.0, 10.0, 20.0)
    assert [percentile(numbers, share) for share in (0, 0.25, 0.5, 0.95, 1)] == [0, 5, 10, 19, 20]


@pytest.mark.long
@pytest.mark.parametrize("kind", [".svg", ".png"])
def test_the_picture_is_the_same_each_time(
    missions: Path, command: Command, tmp_path: Path, kind: str
) -> None:
    """No date, no chance: two of them are the same bytes."""
    pytest.importorskip("matplotlib")
    pictures = [tmp_path / f"{name}{kind}" for name in ("one", "two")]
    for picture in pictures:
        assert command("simulate", missions, "--runs", 4, *CRASHES, "--plot", picture)[0] in (0, 1)
    one, two = (picture.read_bytes() for picture in pictures)
    assert one == two
    assert one.startswith(b"\x89PNG" if kind == ".png" else b"<?xml")


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


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "why"),
    [("p.pdf", "an SVG or a PNG"), ("none/p.svg", "cannot be written: No such file")],
)
def test_a_picture_that_cannot_be_is_exit_2(
    missions: Path, command: Command, tmp_path: Path, name: str, why: str
) -> None:
    """And says why."""
    pytest.importorskip("matplotlib")
    code, _, err = command("simulate", missions, "--runs", 2, "--plot", tmp_path / name)
    assert code == 2
    assert why in err


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
