"""Hours of the day in real flights, by a clock that is set, or goes on while the computer sleeps."""

from __future__ import annotations

import os

import pytest

from tests.hours import real

KINDS = {"it goes on": 0, "it is set forward": 6, "it is set back": 8, "the app is killed": 9}


@pytest.mark.long
@pytest.mark.skipif(
    real.library() is None and not os.environ.get("CI"), reason="apt install libfaketime"
)
@pytest.mark.parametrize("number", KINDS.values(), ids=KINDS)
def test_a_flight_sets_out_at_its_hour_whatever_becomes_of_the_clock(number: int) -> None:
    assert real.flown(number) == []
