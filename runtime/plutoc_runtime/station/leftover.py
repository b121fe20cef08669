"""The flight that is not at its end, from before the station was started."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from ..cli import output
from ..cli.taken_up import TakenUp, take_up
from ..errors import BadInput
from ..journal import place

if TYPE_CHECKING:
    from pathlib import Path

    from ..app import App
    from .settings import Settings

AWAY = "put_away"
"""The file that names the last journal with which nobody wants to go on."""


def found(app: App, settings: Settings) -> TakenUp | None:
    """Return the newest journal of the station's folder, opened, if it can be gone on with."""
    journal = place.newest_in(settings.folder)
    if journal is None or journal.name == _put_away(settings):
        return None
    try:
        taken = take_up(app, journal)
    except BadInput as why:  # somebody else flies it, it is damaged, or it is another app's
        output.tell(f"the last flight cannot be shown: {why}")
        return None
    if taken.is_over or taken.header["sim"] != settings.sim:
        taken.store.close()
        return None
    return taken


def put_away(settings: Settings, journal: Path) -> None:
    """Remember that nobody wants to go on with a journal; it stays where it is."""
    (settings.own_folder / AWAY).write_text(journal.name, encoding="utf-8")


def _put_away(settings: Settings) -> str:
    with suppress(OSError, ValueError):
        return (settings.own_folder / AWAY).read_text(encoding="utf-8")
    return ""
