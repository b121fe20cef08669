"""A drone that has landed takes off again at any moment, also when its firmware disarms it just then."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.flights_crazyflie.pauses import Outcome, pauses, sweep
from tests.flights_crazyflie.team import no_thread_is_left

pytest.importorskip("cflib")
# in real time; tests/library/crazyflie/test_take_off.py has one such pause
pytestmark = pytest.mark.long

AROUND = pauses(2.9, 3.2, 0.05)
"""Seconds: a few pauses around the disarming."""


def test_however_long_the_pause_after_a_landing_is_the_next_take_off_is_flown(
    tmp_path: Path,
) -> None:
    """By drones that arm on request, and by those that arm by themselves, all at once."""

    async def both() -> Sequence[Sequence[Outcome]]:
        return await asyncio.gather(
            *(sweep(AROUND, len(AROUND), tmp_path, auto_arm=alone) for alone in (False, True))
        )

    for outcomes in asyncio.run(both()):
        assert len(outcomes) == len(AROUND)
        assert [(one.pause, one.wrong) for one in outcomes if one.wrong] == []
    assert no_thread_is_left()
