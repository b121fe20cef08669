"""Hooks that misbehave in real flights under a supervisor: their missions alone notice.

`python -m tests.kill.misbehaving --times 3` flies all of it, three times.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.kill.lives import Flight
from tests.kill.misbehaving import TRIALS, Trial
from tests.kill.misfits import misfits_in, plan_of
from tests.kill.trial import end_gateway

pytestmark = pytest.mark.long  # ten seconds each, of real processes

CHOSEN = ("errors that are raised", "children that are ended", "exits that look like an end")
"""A hook's error, one that ends other processes, and one that ends its own."""


@pytest.fixture(scope="session")
def misfits(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the app whose hooks misbehave is imported from."""
    return misfits_in(tmp_path_factory.mktemp("misfits"))


def share(trial: Trial) -> Trial:
    """Return as much of a trial as the tests have time for: two lives of it at most."""
    return replace(trial, missions=trial.missions[:1], lives=2) if trial.lives > 2 else trial


@pytest.mark.parametrize("name", CHOSEN)
def test_all_other_missions_fly_on(name: str, misfits: Path, tmp_path: Path) -> None:
    """The exit code is right, reasons are given, and no process is left running."""
    (trial,) = (share(one) for one in TRIALS if one.name == name)
    assert trial.fly(misfits, tmp_path / "flight") == []


def test_a_hook_that_ends_the_process_ends_no_flight_as_if_it_were_over(
    misfits: Path, tmp_path: Path
) -> None:
    """It is not supervised: the exit code is that of a crash. In a simulation one mission fails."""
    files = plan_of(("leaves", [("leaves0", "act")])).write(tmp_path)
    flight = Flight(app="misfits", source=misfits, folder=tmp_path, speed=20.0)
    try:
        flight.start()
        assert flight.see_through() == 70
        assert "ends it by os._exit(0)" in flight.lives[-1]
    finally:
        flight.end()
        end_gateway(flight.journal)
    (tmp_path / "leaves0.done").unlink()
    simulated = flight.run("simulate", str(files["missions"]), "--fleet", str(files["fleet"]))
    assert simulated.code == 1
    assert "hook act raised SystemExit: os._exit(0)" in simulated.out
    assert "1 of 2 missions completed, 1 failed" in simulated.out
