"""The flight that is not at its end, from before the station was started."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.domain.errors import BadInput

from ..flight.lives import Resumable, how_to_go_on, reopen
from ..journal import place

if TYPE_CHECKING:
    from pathlib import Path

    from plutoc_runtime.domain.app import App

    from ..files.fleet import FleetFile
    from .settings import Settings

AWAY = "put_away"
"""The file that names the last journal with which nobody wants to go on."""


def found(app: App, settings: Settings, going_on: bool = False) -> Resumable | None:
    """Return the newest journal of the station's folder, opened, to be shown and gone on with.

    A flight over another map would be drawn over this one, and misread: it is left alone, unless
    this station was started to go on with it.
    """
    journal = place.newest_in(settings.folder)
    if journal is None or journal.name == _put_away(settings):
        return None
    try:
        taken = reopen(app, journal)
    except BadInput as why:  # somebody else flies it, it is damaged, or it is another app's
        output.tell(f"the last flight cannot be shown: {why}")
        return None
    same = taken.header["sim"], taken.header.get("crtp_sim") is not None
    if same != (settings.sim, settings.crtp_sim is not None):
        taken.store.close()
        return None
    if not going_on and drawn(taken.fleet) != drawn(settings.fleet):
        taken.store.close()
        if taken.is_over:
            return None
        output.tell(
            "the last flight is not shown: it has another map, or other drones, than this station;"
            f" serve with the fleet file with which it began. Without it, {how_to_go_on(app, journal)}"
        )
        return None
    return taken


def drawn(fleet: FleetFile) -> object:
    """Return what people see of a fleet file."""
    return fleet.airspace, [(one.id, one.category, one.home) for one in fleet.drones]


def put_away(settings: Settings, journal: Path) -> None:
    """Remember that nobody wants to go on with a journal; it stays where it is."""
    (settings.own_folder / AWAY).write_text(journal.name, encoding="utf-8")


def _put_away(settings: Settings) -> str:
    with suppress(OSError, ValueError):
        return (settings.own_folder / AWAY).read_text(encoding="utf-8")
    return ""
