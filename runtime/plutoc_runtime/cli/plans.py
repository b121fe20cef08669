"""From the files that a command names to missions and a fleet that can fly them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..errors import BadInput
from ..files.fleet import FleetFile, default_fleet, load_fleet
from ..files.missions import load_missions
from ..files.reading import shortened
from ..plan_check import endless, problems

if TYPE_CHECKING:
    from ..app import App
    from ..model import Mission
    from .options import Options


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What shall be flown, by whom and where."""

    missions: list[Mission[Any]]
    fleet: FleetFile


def load(app: App, options: Options) -> Plan:
    """Return the plan of a command's files; raise `BadInput` where nobody could fly it."""
    fleet = load_fleet(options.fleet, app) if options.fleet else default_fleet(app)
    missions = load_missions(options.missions, app, fleet.airspace)
    found = problems(missions, app, fleet, fleet.airspace)
    if options.command == "simulate" and options.until is None:
        found += endless(missions, app)
    if found:
        raise BadInput(shortened([f"{options.missions}: {sentence}" for sentence in found]))
    return Plan(missions=missions, fleet=fleet)
