"""How long simulated Crazyflies stay: as long as they may be wanted."""

from __future__ import annotations

import os
from pathlib import Path

from pluto_fleet.crtp.process import is_flown
from pluto_fleet.gateway.process import taken


def test_they_stay_while_a_gateway_runs_that_has_nothing_to_tell_them(tmp_path: Path) -> None:
    """A mission may wait for hours, and its drones stand and are only listened to."""
    assert not is_flown(tmp_path)
    lock = taken(tmp_path)
    assert lock is not None
    assert is_flown(tmp_path)
    os.close(lock)
    assert not is_flown(tmp_path)
