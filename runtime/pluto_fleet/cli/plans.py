"""From the files that a command names to missions and a fleet that can fly them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plutoc_runtime import output
from plutoc_runtime.domain.errors import BadInput

from ..files.fleet import DEFAULT_SIZE, FleetFile, as_flown, default_fleet, fleet_of
from ..files.missions import missions_of
from ..files.plan_check import endless, look_alikes, problems
from ..files.reading import parsed, shortened, text_of
from .stand_ins import who_is_missing, with_stand_ins

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission

    from ..journal.header import Header
    from .options import Options


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What shall be flown, by whom and where."""

    app: App
    """As slow as its drones are."""
    missions: list[Mission[Any]]
    fleet: FleetFile
    missions_text: str = ""
    """The file, as it was read."""
    fleet_text: str | None = None
    """The same; None: there was none."""


def load(app: App, options: Options) -> Plan:
    """Return the plan of a command's files; raise `BadInput` where nobody could fly it."""
    fleet, fleet_text = load_fleet(app, options)
    if options.is_real:
        app = as_flown(app, fleet)
    missions_text = text_of(options.missions)
    missions = missions_of(parsed(str(options.missions), missions_text), app, fleet.airspace)
    found = problems(missions, app, fleet, fleet.airspace)
    if (options.command == "simulate" or options.dry_run) and options.until is None:
        found += endless(missions, app)
    if found:
        raise BadInput(shortened([f"{options.missions}: {sentence}" for sentence in found]))
    if not options.supervised:  # then it has been said
        for sentence in look_alikes(missions, fleet.drones):
            output.tell(f"{options.missions}: warning: {sentence}")
    return Plan(
        app=app,
        missions=missions,
        fleet=fleet,
        missions_text=missions_text,
        fleet_text=fleet_text,
    )


def load_fleet(app: App, options: Options) -> tuple[FleetFile, str | None]:
    """Return the fleet of a command's file, and that file's text; None: there is none."""
    text = text_of(options.fleet) if options.fleet else None
    if text is not None and options.crtp_sim is not None and not options.supervised:
        whole = fleet_of(parsed(str(options.fleet), text), app)
        if missing := who_is_missing(whole, options.crtp_sim):
            output.tell(missing)
    return _fleet(app, str(options.fleet), text, options.crtp_sim), text


def fleet_in(app: App, journal: Path, header: Header) -> FleetFile:
    """Return the fleet of a journal; raise `BadInput` if the app does not know it any more."""
    return _fleet(app, f"{journal} (its fleet)", header["fleet"], header.get("crtp_sim"))


def missions_in(app: App, journal: Path, header: Header, fleet: FleetFile) -> list[Mission[Any]]:
    """Return the missions with which a journal begins, as they were planned."""
    document = parsed(f"{journal} (its missions)", header["missions"])
    return missions_of(document, app, fleet.airspace)


def _fleet(app: App, name: str, text: str | None, stand_ins: int | None) -> FleetFile:
    if text is None:
        return default_fleet(app, stand_ins or DEFAULT_SIZE)
    fleet = fleet_of(parsed(name, text), app)
    return fleet if stand_ins is None else with_stand_ins(fleet, stand_ins)
