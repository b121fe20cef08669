"""Commands for an app that does not run, or does not answer: events in its journal, a Stop beside it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import closing, suppress
from typing import TYPE_CHECKING

from ..jobs.reports import Down
from ..journal.header import check
from ..journal.place import gateway_folder
from ..journal.store import Store
from ..shared.domain.text import printable
from .fly import recovered

if TYPE_CHECKING:
    from pathlib import Path

    from ..app import App
    from ..journal.fold import Records
    from ..shared.domain.model import Point

Event = Mapping[str, object]


def record_return(app: App, journal: Path, drone: str, also: Sequence[Event] = ()) -> str:
    """Write into an idle journal that a drone is brought back; return the answer for the user.

    `also` are further events. Raises `BadInput` if that is not possible.
    """
    with closing(Store.open(journal)) as store:
        check(journal, store.header, app)
        event, said = returned(recovered(store).records, drone)
        if event is not None:
            store.append([json.dumps([event, *also])])
    return said


def returned(records: Records, drone: str) -> tuple[Event | None, str]:
    """Return the event of a drone that is brought back, if it was away, and the answer for the user."""
    lost = drone in records.lost
    if not lost and drone not in records.retired:
        return None, f"{printable(drone)} is neither retired nor lost"
    event = {"t": records.time, "event": "drone.brought_back", "drone": drone, "lost": lost}
    when = "it is asked how it is as soon as missions fly"
    return event, f"{drone} is brought back: {when}"


def record_loss(app: App, journal: Path, drone: str, reason: str, at: Point | None) -> None:
    """Write into an idle journal that a drone was lost while no app was running."""
    with closing(Store.open(journal)) as store:
        check(journal, store.header, app)
        event = {"t": recovered(store).records.time, "event": "drone.lost", "drone": drone}
        store.append([json.dumps([{**event, "at": at, "reason": reason}])])


def record_decision(journal: Path, mission: str, answer: str, now: float) -> None:
    """Write the user's answer into an idle journal."""
    event = {"t": now, "event": "mission.decided", "mission": mission, "answer": answer}
    with closing(Store.open(journal)) as store:
        store.append([json.dumps([event])])


def leave_stop(journal: Path, how: Down) -> None:
    """Leave a note that everything was stopped, for the app's next run; `journal` is its real path."""
    file = _stop_file(journal)
    with suppress(OSError):
        file.parent.mkdir(mode=0o700, exist_ok=True)
        file.write_text(how.value, encoding="utf-8")


def pending_stop(journal: Path) -> Down | None:
    """Return how everything was stopped without the app; None: it was not."""
    with suppress(OSError, ValueError):
        return Down(_stop_file(journal).read_text(encoding="utf-8"))
    return None


def clear_stop(journal: Path) -> None:
    """Remove such a note: the user resumes the flight."""
    with suppress(OSError):
        _stop_file(journal).unlink(missing_ok=True)


def _stop_file(journal: Path) -> Path:
    return gateway_folder(journal) / "stopped"
