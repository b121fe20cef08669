"""Loading the missions and the fleet of a command, and `check`."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..files.fleet import (
    FleetFile,
    fleet_of,
    gusty,
    moving_otherwise,
    shared_by_air,
    too_fast,
)
from ..files.missions import missions_of
from ..files.plan_check import (
    endless,
    impossible,
    look_alikes,
    problems,
    uncharged,
    untracked,
    waits,
)
from ..files.reading import parsed, read, text_of
from ..files.stand_ins import fleet_from, missing_categories
from ..files.writing import missions_text
from ..shared import output
from ..shared.domain.app import moving
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted, printable
from ..shared.domain.values import shortened
from ..shared.fleet.reach import idle_actions, reckoned
from ..shared.time.hours import Hours, beginning
from .written import refuse_if_there, write_new

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from ..app import App
    from ..files.reading import MadeOfArea
    from ..shared.domain.model import Mission
    from .options import Options


DRAWN = (".geojson", ".kml", ".plan", ".csv")
"""How names of files end that are written for other programs."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedPlan:
    """What is to be flown, with which fleet."""

    app: App
    """Its drones move as the fleet's."""
    missions: list[Mission[Any]]
    fleet: FleetFile
    file_text: str | None
    """The text of the missions file; None: it needs what it names: lists, areas, places."""
    fleet_text: str | None
    """The text of the fleet file; None: there was none."""
    areas: Sequence[MadeOfArea]
    """What the areas of the missions file have become."""

    @property
    def hours(self) -> Hours:
        """The hours of the day from its start on."""
        return Hours(self.fleet.began, self.fleet.zone)

    @property
    def missions_text(self) -> str:
        """A missions file with these missions: without what lies beside the one that was read."""
        if self.file_text is None:
            return missions_text(self.app, self.missions)
        return self.file_text


def load(app: App, options: Options) -> LoadedPlan:
    """Return the plan of a command's files; raise `BadInput` if it cannot be flown."""
    fleet, fleet_text = load_fleet(app, options)
    fleet = replace(fleet, **_beginning(options))
    if options.no_spread or options.dry_run:
        fleet = replace(fleet, motion=fleet.motion.exact)
    app = moving(app, fleet.motion)
    document = read(options.missions)
    document.landmarks = fleet.landmarks
    missions = missions_of(document, app, fleet.airspace)
    if not options.supervised:
        for note in document.notes:
            output.tell(f"{options.missions}: warning: {printable(note)}")
    sizes = options.command == "size"  # it says what no fleet can do
    found = [] if sizes else problems(missions, app, fleet, fleet.airspace)
    if (sizes or options.command == "simulate" or options.dry_run) and options.until is None:
        found += endless(missions, app)
    if found:
        raise BadInput(shortened([f"{options.missions}: {sentence}" for sentence in found]))
    if not options.supervised:  # its supervisor has said so
        warnings = [*look_alikes(missions, fleet.drones)]
        real = options.is_real and options.stand_ins is None
        either = options.command == "check"
        told = untracked(missions, app, fleet, real=real or either, simulated=not real)
        warnings += [] if told is None else [told]
        if options.command != "check":
            warnings += impossible(missions, app, fleet, Hours(fleet.began, fleet.zone))
        for sentence in warnings:
            output.tell(f"{options.missions}: warning: {sentence}")
    return LoadedPlan(
        app=app,
        missions=missions,
        fleet=fleet,
        file_text=None if document.is_made else document.text,
        areas=document.areas,
        fleet_text=fleet_text,
    )


def _beginning(options: Options) -> Mapping[str, Any]:
    """Return when what is loaded begins, and in which zone."""
    flies = options.command == "fly"
    if not options.says_when and (flies or options.command == "check"):
        return {"began": time.time(), "zone": ""}
    # a dry run is of a flight, whose hours are those of a day of this computer's
    zone = "" if flies and options.zone is None else options.zone
    return beginning(options.date, options.start, zone)


def load_fleet(app: App, options: Options) -> tuple[FleetFile, str | None]:
    """Return the fleet of a command's file, and that file's text; None: there is none."""
    text = text_of(options.fleet) if options.fleet else None
    stand_ins = options.stand_ins
    if text is not None and stand_ins is not None and not options.supervised:
        whole = fleet_of(parsed(str(options.fleet), text), app)
        if missing := missing_categories(whole, stand_ins):
            output.tell(missing)
    return fleet_from(app, str(options.fleet), text, stand_ins), text


def _written_as(path: Path, plan: LoadedPlan) -> str:
    """Return the missions as the name of a file says: as a missions file, or as a drawing for other programs."""
    if path.suffix.lower() not in DRAWN:
        return plan.missions_text
    from ..files.drawings.writing import WRITERS  # few ask for it
    from ..files.drawn_missions import features_of

    if plan.fleet.plane is None:
        raise BadInput(
            f"{path}: its places would be degrees on the Earth, and the map has no origin: write one below"
            " [map] of the fleet file"
        )
    output.tell(f"{path}: places, heights and actions; all else stands in a missions file alone")
    return WRITERS[path.suffix.lower()](features_of(plan.missions, plan.fleet.plane))


FLEET = "fleet.toml"


def take_fleet_beside(options: Options) -> None:
    """Use the fleet file beside the missions if none is named; real drones need a named one."""
    missions = _missions(options)
    if missions is None or options.fleet is not None:
        return
    fleet = missions.parent / FLEET
    if os.path.lexists(fleet):
        options.fleet = fleet
        if not options.supervised:
            output.tell(
                f"fleet: {printable(os.fspath(fleet))}, beside the missions; or name one: --fleet"
            )


def _missions(options: Options) -> Path | None:
    """Return the missions file of a command that flies nothing real, if any."""
    simulated = options.sim or options.stand_ins is not None
    match options.command:
        case "simulate" | "check" | "size":
            return options.missions
        case "fly" if simulated:
            return options.missions
        case "serve" if simulated:
            return options.plan
        case _:
            return None


_MOST_AREAS = 50
"""The most areas of which `check` says what they have become."""


_MOST_WAITS = 50
"""The most missions of which is said for what they wait."""


def waiting(plan: LoadedPlan) -> Iterator[str]:
    """Yield for what missions wait, and until when."""
    found = [*waits(plan.missions, plan.hours)]
    yield from map(printable, found[:_MOST_WAITS])
    if (more := len(found) - _MOST_WAITS) > 0:
        yield f"… and {more} more wait"


def check(app: App, options: Options) -> int:
    """Confirm that the fleet can fly the missions, and keep its promises; else loading has raised an error."""
    refuse_if_there(options.write)
    plan = load(app, options)
    doubts = [
        *too_fast(app, plan.fleet),
        *shared_by_air(plan.fleet),
        *moving_otherwise(plan.fleet),
        *gusty(plan.fleet),
        *idle_actions(app, plan.fleet),
    ]
    if scarce := uncharged(plan.missions, plan.app, plan.fleet):
        doubts.append(scarce)
    for sentence in doubts:
        output.tell(f"{options.fleet or app.name}: warning: {sentence}")
    hours = plan.hours if options.says_when else None
    broken = impossible(plan.missions, plan.app, plan.fleet, hours)
    if broken:
        output.tell(shortened([f"{options.missions}: {sentence}" for sentence in broken]))
        return 1
    for assumed in reckoned(plan.app, plan.missions):
        output.line(printable(assumed))
    for area in plan.areas[:_MOST_AREAS]:
        output.line(printable(area.sentence))
    if (more := len(plan.areas) - _MOST_AREAS) > 0:
        output.line(f"… and {counted(more, 'more area')}")
    for sentence in waiting(plan):
        output.line(sentence)
    if options.write is not None:
        write_new(options.write, _written_as(options.write, plan), "the missions")
    last = (
        ""
        if plan.fleet.charges_at_home
        else ", as long as its batteries last: nothing charges them"
    )
    trips = sum(len(mission.trips) for mission in plan.missions)
    missions, drones = len(plan.missions), len(plan.fleet.drones)
    output.line(
        f"{counted(missions, 'mission')} with {counted(trips, 'trip')}: "
        f"a fleet of {counted(drones, 'drone')} can fly them{last}"
    )
    return 0
