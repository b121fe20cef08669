"""Tests that any navigation must pass, and any tracker: subclass a contract in a test file, and run pytest.

The subclass's `make` returns a navigation, or a tracker. `docs/navigation.md` shows both.
"""

from __future__ import annotations

from .contract import NavigationContract
from .recording import Truth
from .trackers import TrackerContract

__all__ = ["NavigationContract", "TrackerContract", "Truth"]
