"""Commands for an app that does not run, or does not answer: events in its journal, a Stop beside it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import closing, suppress
from typing import TYPE_CHECKING

from ..jobs.reports import Down
from ..journal.header import check
from ..journal.place import gateway_folder
from ..journal.store import Entry, Store
from ..shared.domain.text import printable

if TYPE_CHECKING:
    from pathlib import Path

    from ..app import App
    from ..journal.standing import Standing
    from ..shared.domain.model import Point

Event = Mapping[str, object]


def record_return(app: App, journal: Path, drone: str, also: Sequence[Event] = ()) -> str:
    """Write into an idle journal that a drone is brought back; return the answer for the user.

    `also` are further events. Raises `BadInput` if that is not possible.
    """
    with closing(Store.open(journal)) as store:
        check(journal, store.header, app)
        standing = store.standing()
        event, said = returned(standing, drone)
        if event is not None:
            row = standing.bring_back(drone)
            store.append([Entry(json.dumps([event, *also]), [row])])
    return said


def returned(standing: Standing, drone: str) -> tuple[Event | None, str]:
    """Return the event of a drone that is brought back, if it was away, and the answer for the user."""
    lost = drone in standing.lost
    if not lost and drone not in standing.retired:
        return None, f"{printable(drone)} is neither retired nor lost"
    event = {"t": standing.time, "event": "drone.brought_back", "drone": drone, "lost": lost}
    when = "it is asked how it is as soon as missions fly"
    return event, f"{drone} is brought back: {when}"


def record_loss(app: App, journal: Path, drone: str, reason: str, at: Point | None) -> None:
    """Write into an idle journal that a drone was lost while no app was running."""
    with closing(Store.open(journal)) as store:
        check(journal, store.header, app)
        standing = store.standing()
        event = {"t": standing.time, "event": "drone.lost", "drone": drone, "at": at}
        row = standing.lose(drone, reason, at)
        store.append([Entry(json.dumps([{**event, "reason": reason}]), [row])])


def record_decision(journal: Path, mission: str, answer: str) -> None:
    """Write the user's answer into an idle journal."""
    with closing(Store.open(journal)) as store:
        standing = store.standing()
        store.append([decided(standing, mission, answer)])


def decided(standing: Standing, mission: str, answer: str) -> Entry:
    """Return what is written of a user's answer."""
    event = {"t": standing.time, "event": "mission.decided", "mission": mission, "answer": answer}
    record = standing.missions[mission]
    accepted = record["at"] if answer == "go-on" else record["accepted"]
    row = {**standing.row_of(mission), "answer": answer, "accepted": accepted}
    return Entry(json.dumps([event]), [("mission", (mission,), row)])


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
