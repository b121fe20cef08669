"""What befalls drones while nothing flies: one is lost, or was looked after, and the journal says so."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import closing
from typing import TYPE_CHECKING

from plutoc_runtime.domain.text import printable

from ..flight.fly import recovered
from ..journal.header import check
from ..journal.store import Store

if TYPE_CHECKING:
    from pathlib import Path

    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Point

    from ..journal.fold import Records

Event = Mapping[str, object]


def looked_after(app: App, journal: Path, drone: str, also: Sequence[Event] = ()) -> str:
    """Put it on record in a journal that nobody is writing; `BadInput` if that cannot be.

    `also` are events that go with it.
    """
    with closing(Store.open(journal)) as store:
        check(journal, store.header, app)
        event, said = brought_back(recovered(store).records, drone)
        if event is not None:
            store.append([json.dumps([event, *also])])
    return said


def lost_meanwhile(app: App, journal: Path, drone: str, reason: str, at: Point | None) -> None:
    """Put on record that a drone was lost while no app was there to be told."""
    with closing(Store.open(journal)) as store:
        check(journal, store.header, app)
        event = {"t": recovered(store).records.time, "event": "drone.lost", "drone": drone}
        store.append([json.dumps([{**event, "at": at, "reason": reason}])])


def brought_back(records: Records, drone: str) -> tuple[Event | None, str]:
    """Return what is to go on record, if anything is, and what to say."""
    lost = drone in records.lost
    if not lost and drone not in records.retired:
        return None, f"{printable(drone)} is neither retired nor lost"
    event = {"t": records.time, "event": "drone.brought_back", "drone": drone, "lost": lost}
    when = "it is asked how it is as soon as missions fly"
    return event, f"{drone} is brought back: {when}"
