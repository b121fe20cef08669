"""Compiles an example and flies it in this process."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from contextlib import redirect_stderr, redirect_stdout
from copy import deepcopy
from dataclasses import dataclass
from importlib import import_module
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pluto_fleet.app import described
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.alone.faults import Faults
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.trials.invariants import Items, items_of
from plutoc.cli import main
from tests.paths import ROOT

if TYPE_CHECKING:
    from pluto_fleet.flight.outcome import SimulationResult
    from pluto_fleet.shared.domain.model import Mission

EXAMPLES = ROOT / "examples"
NAMES = sorted(path.parent.name for path in EXAMPLES.glob("*/app.pluto"))

A_WEEK = 7 * 86_400.0
"""Seconds. A mission that has not ended by then never will: its end is missed in the trace."""

MISHAPS = {"crash": 0.10, "link": 0.05, "action": 0.05}
"""What `--fail crash=10%,link=5%,action=5%` lets go wrong."""


STRAIGHT_LEGS = '[motion]\nlegs = "straight"\n'
"""What a fleet file says whose drones are to be back in half of the time that a Crazyflie takes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flown:
    """What came of one run."""

    outcome: SimulationResult
    trace: Sequence[Event]

    @property
    def ends(self) -> list[tuple[str, str]]:
        """How each mission ended, and why if it failed."""
        return [(mission.status.value, mission.reason) for mission in self.outcome.missions]


@dataclass(frozen=True, slots=True, kw_only=True)
class Example:
    """An example's package, imported, with its own two files."""

    name: str
    package: Path
    missions: Sequence[Mission[Any]]
    items: Items
    fleet: Any

    def fly(self, seed: int, mishaps: Mapping[str, float] | None = None) -> Flown:
        """Simulate the missions to their end."""
        trace: list[Mapping[str, object]] = []
        outcome = simulate(
            described(import_module(f"{self.name}.flow").APP),
            deepcopy(self.missions),
            self.fleet,
            seed=seed,
            faults=Faults(**(mishaps or {})),
            until=A_WEEK,
            on_event=trace.append,
        )
        return Flown(outcome=outcome, trace=trace)


def fly_straight(fleet: Path) -> None:
    """Let the drones of a fleet file fly straight."""
    with fleet.open("a", encoding="utf-8") as file:
        file.write(f"\n{STRAIGHT_LEGS}")


def compiled(name: str, into: Path) -> Path:
    """Compile an example as a person would, and return the package's folder."""
    return compiled_file(EXAMPLES / name / "app.pluto", into / name)


def compiled_file(source: Path, package: Path) -> Path:
    """Compile an app as a person would, and return the package's folder."""
    said = StringIO()
    with redirect_stdout(said), redirect_stderr(said):
        code = main(["compile", str(source), "-o", str(package)])
    if code != 0:
        raise AssertionError(f"plutoc compile of {source} ended with {code}:\n{said.getvalue()}")
    return package


def built(name: str, into: Path) -> Example:
    """Compile and import an example, and read its missions and its fleet."""
    package = compiled(name, into)
    forgotten = [known for known in sys.modules if known.split(".")[0] == name]
    for module in forgotten:
        del sys.modules[module]
    sys.path.insert(0, str(package / "src"))
    try:
        app = described(import_module(f"{name}.flow").APP)
        fleet = load_fleet(EXAMPLES / name / "fleet.toml", app)
        missions = load_missions(EXAMPLES / name / "missions.toml", app, fleet.airspace)
    finally:
        sys.path.remove(str(package / "src"))
    return Example(
        name=name, package=package, missions=missions, items=items_of(missions), fleet=fleet
    )
