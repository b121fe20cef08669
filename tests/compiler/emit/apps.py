"""Apps for tests of what is emitted."""

from __future__ import annotations

from pathlib import Path

_FOLDER = Path(__file__).with_name("sources")

PLAIN = (_FOLDER / "plain.pluto").read_text(encoding="utf-8")
"""Without a title, a hook, a category or a field."""
PARCELS = (_FOLDER / "parcels.pluto").read_text(encoding="utf-8")
"""Drones that can do nothing without an item."""
ODD_NAMES = (_FOLDER / "odd.pluto").read_text(encoding="utf-8")
"""Names that Python, or the generated code itself, has already."""
EVENTS = (_FOLDER / "events.pluto").read_text(encoding="utf-8")
"""Events, actions on the way, creators; odd names, too."""
TYPED = (_FOLDER / "typed.pluto").read_text(encoding="utf-8")
"""Fields of its own, evaluators with parameters, and actions that say what they give; odd names, too."""
