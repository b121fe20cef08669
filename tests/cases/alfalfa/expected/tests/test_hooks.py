"""Tests of hooks.py: yours. plutoc wrote this file once, and never touches it again.

An evaluator can be tested with a mission and results made by hand:

    from alfalfa import Mission, Results

    results = Results(new=(), all=())
    assert hooks.find_blooms(Mission(name="a test", trips=[]), results).ok
"""

from __future__ import annotations

from alfalfa import hooks


def test_pollinate_can_be_called() -> None:
    assert callable(hooks.pollinate)


def test_find_blooms_can_be_called() -> None:
    assert callable(hooks.find_blooms)
