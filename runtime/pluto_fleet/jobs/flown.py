"""What a drone has flown, as plain data: one command of it, and how that went (docs/journal.md)."""

from __future__ import annotations

from collections.abc import Mapping

Flown = Mapping[str, object]
"""A command that is over, such as a leg, with the seconds that it took."""

FLEW = "drone.flew"
"""The event of a journal that holds one."""

TAKE_OFF, LEG, LAND, ACTION = "take_off", "leg", "land", "action"
"""What the command was: the fact `what`."""

DONE, BROKEN_OFF, FAILED = "done", "broken off", "failed"
"""How it ended: the fact `ended`."""
