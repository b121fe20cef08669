"""Flights, and the limits that are set for them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from pluto_fleet.shared.flow.flight import Limit


@pytest.mark.parametrize(
    ("flight_is_over", "branch_is_over", "void"),
    [
        (False, None, False),
        (False, False, False),
        (False, True, True),
        (True, None, True),
        (True, False, True),
    ],
)
def test_a_limit_is_void_once_the_flight_or_the_branch_that_set_it_is_over(
    flight_is_over: bool, branch_is_over: bool | None, void: bool
) -> None:
    limit = Limit(0.0, 1.0, lambda trip, span: "late")
    flight: Any = SimpleNamespace(is_set=flight_is_over)
    limit.flight = flight
    branch: Any = None if branch_is_over is None else SimpleNamespace(is_set=branch_is_over)
    limit.branch = branch
    assert limit.is_void is void
