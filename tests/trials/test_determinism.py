"""The same trial leaves the same trace, whatever Python's own hashes are."""

from __future__ import annotations

from invariants import hashes


def test_a_trial_does_not_depend_on_hashes() -> None:
    """With a journal, faults, a crash and all that comes of it."""
    one, two, three = hashes(missions=60, trips=2, drones=20)
    assert one == two == three
