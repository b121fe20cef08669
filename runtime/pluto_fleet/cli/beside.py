"""The fleet file that lies beside the missions: taken where nothing real flies, and that is said."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.domain.text import printable

if TYPE_CHECKING:
    from .options import Options

FLEET = "fleet.toml"


def take_fleet_beside(options: Options) -> None:
    """Take it where no other one is named. Real drones fly only by a file that somebody has named."""
    missions = _missions(options)
    if missions is None or options.fleet is not None:
        return
    fleet = missions.parent / FLEET
    if os.path.lexists(fleet):
        options.fleet = fleet
        output.tell(
            f"fleet: {printable(os.fspath(fleet))}, beside the missions; or name one: --fleet"
        )


def _missions(options: Options) -> Path | None:
    """Return the missions file of a command that flies nothing real; None: there is none."""
    simulated = options.sim or options.crtp_sim is not None
    match options.command:
        case "simulate" | "check":
            return options.missions
        case "fly" if simulated:
            return options.missions
        case "serve" if simulated:
            return options.plan
        case _:
            return None
