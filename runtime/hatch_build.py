"""Puts a copy of the brain into the library, where it is built to be installed elsewhere."""

from __future__ import annotations

from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class CopyOfTheBrain(BuildHookInterface):
    """What an app does not carry, the library brings; in a checkout it finds the source beside it."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the copy to a wheel, but not to an editable one: there it would grow old."""
        if version != "editable":
            build_data["force_include"]["plutoc_runtime"] = "pluto_fleet/_brain"
