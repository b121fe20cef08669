"""Fits journals of drones whose motion is known, and counts how often that is in the intervals told."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from pluto_fleet.calibration.commands import read_flights
from pluto_fleet.calibration.estimates import Calibration
from pluto_fleet.calibration.fit import calibrated
from pluto_fleet.calibration.report import NAMES
from pluto_fleet.shared.domain.motion import CRAZYFLIE, STRAIGHT, Motion, varied
from tests.calibrating.flights import surveyed

SHARE = 0.95
"""Of the cases, at least, every value must be in its interval."""


@dataclass(slots=True)
class Tally:
    """What came of the cases."""

    cases: int = 0
    whole: int = 0
    """The cases with every value in its interval."""
    told: Counter[str] = field(default_factory=Counter)
    inside: Counter[str] = field(default_factory=Counter)
    missed: list[str] = field(default_factory=list)
    noted: list[str] = field(default_factory=list)
    """What was noted, though in all cases there is nothing to note."""

    def add(self, case: int, truth: Motion, what: Calibration) -> None:
        """Count a case."""
        missed = []
        for name, found in what.found.items():
            true = getattr(truth, name, 1.0)  # simulated drones charge as their category says
            self.told[name] += 1
            if found.low <= true <= found.high:
                self.inside[name] += 1
            else:
                missed.append(f"{name} is {true:.5f}, not {found.low:.5f} … {found.high:.5f}")
        self.cases += 1
        self.whole += not missed
        self.missed += [f"case {case}: {one}" for one in missed]
        self.noted += [f"case {case}: noted: {one}" for one in what.notes]

    def lines(self) -> list[str]:
        """Return what to print."""
        each = [f"{name:14} {self.inside[name]} of {self.told[name]}" for name in NAMES]
        return [*each, f"all of a case  {self.whole} of {self.cases}", *self.missed, *self.noted]


def truth_of(case: int) -> Motion:
    """Return how the drones of a case move."""
    chance = Random(f"{case}/truth")
    model = STRAIGHT if chance.random() < 0.25 else CRAZYFLIE
    return replace(
        model,
        pace=chance.uniform(0.8, 1.4),
        take_off=chance.uniform(0.0, 1.5),
        settles=chance.uniform(0.0, 1.0),
        landing=chance.uniform(0.0, 3.0),
        spread=chance.uniform(0.005, 0.1),
        action_spread=chance.uniform(0.01, 0.15),
        drain=chance.uniform(0.7, 1.4),
    )


def fitted(case: int) -> tuple[Motion, Calibration]:
    """Fly a case, and fit its journal; its fleet file knows nothing of how the drones really move."""
    chance, truth = Random(f"{case}/plan"), truth_of(case)
    said = STRAIGHT if truth.legs == "straight" else CRAZYFLIE
    with TemporaryDirectory() as folder:
        path = surveyed(
            Path(folder, "journal"),
            truth,
            said=said,
            trips=chance.randint(15, 90),
            drones=chance.randint(1, 4),
            speed=chance.uniform(0.3, 1.0),
            seed=case,
        )
        return varied(truth, case), calibrated([read_flights(path)], said)
