"""Fits journals of drones whose motion is known, and counts how often that is in the intervals told."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from math import comb, inf
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from pluto_fleet.calibration.commands import read_flights
from pluto_fleet.calibration.estimates import SURE, Calibration
from pluto_fleet.calibration.fit import calibrated
from pluto_fleet.calibration.report import NAMES
from pluto_fleet.shared.domain.motion import CRAZYFLIE, STEADY, STRAIGHT, Motion, varied
from tests.calibrating.flights import surveyed

CHANCE = 0.05
"""How probable it must be at least that no more cases are told right, if all intervals hold as often as they say."""
OPEN = 0.15
"""Of the cases, at most, may leave open what shapes their legs."""


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
    open: list[str] = field(default_factory=list)
    """What could not be told, and is not as was said: what else was found hangs on that, and is not judged."""

    @property
    def chance(self) -> float:
        """How probable it is that no more cases are told right than are, if intervals hold as often as they say."""
        return sum(
            comb(self.cases, right) * SURE**right * (1 - SURE) ** (self.cases - right)
            for right in range(self.whole + 1)
        )

    def add(self, case: int, truth: Motion, what: Calibration) -> None:
        """Count a case."""
        hidden = [name for name in what.untold if _differs(name, truth, what.model)]
        if hidden:
            self.open.append(f"case {case}: {' and '.join(hidden)} cannot be told")
            return
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
        whole = f"all of a case  {self.whole} of {self.cases}"
        return [*each, whole, *self.missed, *self.noted, *self.open]


def _differs(name: str, truth: Motion, said: Motion) -> bool:
    """Return whether a value that shapes legs is not as was said."""
    return name in SHAPES and getattr(truth, name) != getattr(said, name)


SHAPES = ("acceleration", "jerk", "up", "down", "touch_down")
OUTDOORS = replace(STEADY, low=2.0)
"""What is said of a multicopter; on the maps of these cases it lands from 9 m at most."""


def said_of(case: int) -> Motion:
    """Return how a case's drones are said to move, and do but for what is drawn."""
    drawn = Random(f"{case}/kind").random()
    return STRAIGHT if drawn < 0.2 else OUTDOORS if drawn < 0.5 else CRAZYFLIE


def truth_of(case: int) -> Motion:
    """Return how the drones of a case move."""
    chance = Random(f"{case}/truth")
    said = said_of(case)
    drawn = replace(
        said,
        pace=chance.uniform(0.8, 1.4),
        take_off=chance.uniform(0.0, 1.5),
        settles=chance.uniform(0.0, 1.0),
        landing=chance.uniform(0.0, 3.0),
        spread=chance.uniform(0.005, 0.1),
        action_spread=chance.uniform(0.01, 0.15),
        drain=chance.uniform(0.7, 1.4),
    )
    if said is not OUTDOORS:
        return drawn
    return replace(
        drawn,
        settles=chance.uniform(1.0, 3.0),
        take_off=chance.uniform(0.5, 2.0),
        acceleration=chance.uniform(1.5, 4.0),
        down=chance.uniform(0.8, 2.5),
        spread=chance.uniform(0.01, 0.03),
    )


def fitted(case: int) -> tuple[Motion, Calibration]:
    """Fly a case, and fit its journal; its fleet file knows nothing of how the drones really move."""
    chance, truth = Random(f"{case}/plan"), truth_of(case)
    said = said_of(case)
    outdoors = said is OUTDOORS
    with TemporaryDirectory() as folder:
        path = surveyed(
            Path(folder, "journal"),
            truth,
            said=said,
            trips=chance.randint(60, 120) if outdoors else chance.randint(15, 90),
            drones=chance.randint(1, 4),
            speed=chance.uniform(5.0, 10.0) if outdoors else chance.uniform(0.3, 1.0),
            within=79.0 if outdoors else 12.0,
            highest=9.0 if outdoors else 1.8,
            near=40.0 if outdoors else inf,
            seed=case,
        )
        return varied(truth, case), calibrated([read_flights(path)], said)
