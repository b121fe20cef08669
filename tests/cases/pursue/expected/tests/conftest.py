"""What the tests of hooks share: yours. plutoc wrote this file once, and never touches it again."""

from __future__ import annotations

import pytest

from pursue import Drone, Mission, Trip
from pursue.testing import Clock, Kit, KitContext


@pytest.fixture
def kit() -> Kit:
    """Return what makes all the others, and calls hooks."""
    return Kit()


@pytest.fixture
def clock(kit: Kit) -> Clock:
    """Return the time, which stands still until a test moves it."""
    return kit.clock


@pytest.fixture
def drone(kit: Kit) -> Drone:
    """Return a drone of the first category, with a full battery."""
    return kit.drone()


@pytest.fixture
def mission(kit: Kit) -> Mission:
    """Return a mission with one trip."""
    return kit.mission()


@pytest.fixture
def trip(mission: Mission) -> Trip:
    """Return the trip of the mission."""
    return mission.current


@pytest.fixture
def context(kit: Kit) -> KitContext:
    """Return the context for an action or a modifier."""
    return kit.context()
