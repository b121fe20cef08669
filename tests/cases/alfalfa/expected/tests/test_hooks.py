"""Tests of hooks.py: yours. plutoc wrote this file once, and never touches it again."""

from __future__ import annotations

from alfalfa import Mission, Results, hooks


def test_find_blooms_accepts_a_mission_without_results() -> None:
    mission = Mission(name="test", trips=[])
    assert hooks.find_blooms(mission, Results(new=(), all=())).ok


def test_pollinate_can_be_called() -> None:
    assert callable(hooks.pollinate)
