"""Tests that any navigation must pass: subclass `NavigationContract` in a test file, and run pytest.

The subclass's `make` returns a navigation. `docs/navigation.md` shows one.
"""

from __future__ import annotations

from .contract import NavigationContract
from .recording import Truth

__all__ = ["NavigationContract", "Truth"]
