"""`bring-back` while nothing flies: a person has looked after a drone, and the journal remembers it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import closing
from typing import TYPE_CHECKING

from ..fly import recovered
from ..journal.header import check
from ..journal.store import Store
from ..words import printable

if TYPE_CHECKING:
    from pathlib import Path

    from ..app import App
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


def motors_cut(app: App, journal: Path, drone: str) -> None:
    """Put on record that a drone's motors were cut while nobody was there to be told."""
    with closing(Store.open(journal)) as store:
        check(journal, store.header, app)
        event = {"t": recovered(store).records.time, "event": "drone.lost", "drone": drone}
        store.append([json.dumps([{**event, "at": None, "reason": f"{drone}'s motors were cut"}])])


def brought_back(records: Records, drone: str) -> tuple[Event | None, str]:
    """Return what is to go on record, if anything is, and what to say."""
    lost = drone in records.lost
    if not lost and drone not in records.retired:
        return None, f"{printable(drone)} is neither retired nor lost"
    event = {"t": records.time, "event": "drone.brought_back", "drone": drone, "lost": lost}
    when = "it is asked how it is as soon as missions fly"
    return event, f"{drone} is brought back: {when}"
