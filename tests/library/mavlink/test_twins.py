"""Two vehicles with one system id are seen by what they tell, and one that is only badly heard is none of them."""

from __future__ import annotations

from pluto_fleet.mavlink.twins import Twins

EACH = 100
"""Milliseconds between two positions."""


def test_clocks_that_differ_are_those_of_two() -> None:
    twins = Twins()
    for number in range(10):
        twins.hear(number * EACH, (5.0, 5.0, 0.0), 0.0)
        twins.hear(90_000 + number * EACH, (5.2, 5.0, 0.0), 0.0)
    assert twins.are_there


def test_places_that_differ_are_those_of_two() -> None:
    """Also where they were switched on together."""
    twins = Twins()
    for number in range(10):
        twins.hear(number * EACH, (5.0, 5.0, 0.0), 0.0)
        twins.hear(number * EACH + 30, (8.0, 5.0, 0.0), 0.0)
    assert twins.are_there


def test_one_that_is_heard_by_two_ways_restarts_and_flies_fast_is_one() -> None:
    twins = Twins()
    flown = [(number * EACH, (1.5 * number, 5.0, 3.0)) for number in range(40)]
    for place, late in zip(flown[3:], flown, strict=False):
        twins.hear(*place, 15.0)
        twins.hear(*late, 15.0)
    assert not twins.are_there
    for number in range(40):
        twins.hear(number * EACH, (70.0, 5.0, 0.0), 0.0)  # it was switched on anew
    assert not twins.are_there
