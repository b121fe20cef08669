"""A drone that has landed takes off again at any moment, also when its firmware disarms it just then."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.flights_crazyflie.pauses import pauses, sweep
from tests.kit.unthreaded import in_virtual_time

pytest.importorskip("cflib")

AROUND = pauses(2.9, 3.2, 0.05)
"""Seconds: a few pauses around the disarming."""


@pytest.mark.parametrize("auto_arm", [False, True])
def test_however_long_the_pause_after_a_landing_is_the_next_take_off_is_flown(
    auto_arm: bool, tmp_path: Path
) -> None:
    """By drones that arm on request, and by those that arm by themselves."""
    outcomes = in_virtual_time(sweep(AROUND, len(AROUND), tmp_path, auto_arm=auto_arm))
    assert [(one.pause, one.wrong) for one in outcomes] == [(pause, "") for pause in AROUND]
