"""A simulated drone passes the kit."""

from __future__ import annotations

from tests.library.navigation.simulated import SimulatedContract


class TestSimulated(SimulatedContract):
    """It does what it must."""
