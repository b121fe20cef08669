"""The list of alerts: each arises, is acknowledged by a person, and is over; it outlives the station."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, cast, get_type_hints

from ...shared.domain.errors import BadInput
from ...shared.domain.text import quoted
from ..feed import VersionedRows
from ..wire import Alert

if TYPE_CHECKING:
    from .causes import Cause

FILE = "attention.json"
KEPT = 200
"""The most alerts that are kept: of those that are over, the oldest are forgotten first."""
OF_A_DRONE = ("lost", "crashed")
"""The kinds of alerts that last from one flight to the next."""
ONCE = ("finding", "drained")
"""The kinds of alerts of what has happened, and is over once a person knows of it."""


class Attention:
    """The alerts of a station, in a file of its folder."""

    def __init__(self, file: Path, now: Callable[[], float]) -> None:
        """`now` is in seconds since 1970."""
        self._file, self._now = file, now
        self.rows: VersionedRows[Alert] = VersionedRows()
        """Them, for pages."""
        self._alerts: dict[str, Alert] = {one["id"]: one for one in _kept(file)}
        self._open = {_key(id): id for id, one in self._alerts.items() if not one["over"]}
        self._told = False

    def look(self, flight: str, causes: Iterable[Cause], version: int) -> bool:
        """Note what has arisen, changed and ended; return whether anything has.

        What has happened once is over when it has been acknowledged, anything else when its cause is.
        """
        found = {_named(flight, one): one for one in causes}
        changed = arisen = False
        for key, cause in found.items():
            if key in self._open:
                changed |= self._update(self._alerts[self._open[key]], cause)
            elif cause.kind not in ONCE or f"{key}/1" not in self._alerts:
                arisen = True
                self._arise(key, cause)
        for key, id in list(self._open.items()):
            alert = self._alerts[id]
            known = alert["by_at"] is not None
            if key not in found or (known and alert["kind"] in ONCE):
                alert["over"], arisen = True, True
                del self._open[key]
        self._forget(found.keys())
        if arisen:
            self._keep()
        if arisen or changed or not self._told:
            self._told = changed = True
            for id, alert in self._alerts.items():
                self.rows.put(id, {**alert}, version)
        return arisen or changed

    def acknowledge(self, id: str, by: str) -> str:
        """Note that a person knows of an alert; `by` is their name, if they have said one."""
        alert = self._alerts.get(id)
        if alert is None:
            raise BadInput(f"there is no alert {quoted(id)} any more")
        if alert["by_at"] is not None:
            return f"acknowledged already{_by(alert['by'])}"
        alert["by"], alert["by_at"] = by, round(self._now() * 1000)
        self._told = False
        self._keep()
        return f"acknowledged{_by(by)}"

    def _arise(self, key: str, cause: Cause) -> None:
        number = 1
        while f"{key}/{number}" in self._alerts:
            number += 1
        id = f"{key}/{number}"
        x, y, *_ = cause.at if cause.at is not None else (None, None)
        self._alerts[id] = {
            "id": id,
            "kind": cause.kind,
            "urgent": cause.urgent,
            "mission": cause.mission,
            "drone": cause.drone,
            "x": x,
            "y": y,
            "since_at": round(self._now() * 1000),
            "said": cause.said,
            "over": False,
            "by": None,
            "by_at": None,
        }
        self._open[key] = id

    def _update(self, alert: Alert, cause: Cause) -> bool:
        """Say what is so by now; the sentence changes while an alert lasts."""
        if alert["said"] == cause.said:
            return False
        alert["said"] = cause.said
        return True

    def _forget(self, found: Collection[str]) -> None:
        """Forget what is over, but not what would arise again."""
        over = [id for id, one in self._alerts.items() if one["over"] and _key(id) not in found]
        for id in over[: max(0, len(self._alerts) - KEPT)]:
            del self._alerts[id]
            self.rows.drop(id)

    def _keep(self) -> None:
        text = json.dumps(list(self._alerts.values()))
        with suppress(OSError):  # what they are about is in the journals, too
            part = self._file.with_name(f"{self._file.name}.part")
            part.write_text(text, encoding="utf-8")
            part.replace(self._file)


def _named(flight: str, cause: Cause) -> str:
    """Return what tells a cause apart from all others of this station."""
    return "/".join(["" if cause.kind in OF_A_DRONE else flight, cause.kind, cause.about])


def _key(id: str) -> str:
    return id.rpartition("/")[0]


def _by(name: str | None) -> str:
    return f" by {name}" if name else ""


def _kept(file: Path) -> list[Alert]:
    """Return the alerts of an earlier station; none if they cannot be read."""
    with suppress(OSError, ValueError):
        found = json.loads(file.read_text(encoding="utf-8"))
        if isinstance(found, list) and all(_is_alert(one) for one in found):
            return cast(list[Alert], found)
    return []


def _is_alert(data: object) -> bool:
    return isinstance(data, dict) and data.keys() == get_type_hints(Alert).keys()
