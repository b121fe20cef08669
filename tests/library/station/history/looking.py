"""A page that looks at a flight until its end, and keeps all that it was shown."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any

from tests.kit.station import Station, until

ENDS = ("over", "stopped", "interrupted")


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """What a page shows from an instant on."""

    t: float
    state: dict[str, Any]
    missions: dict[str, Any]
    drones: dict[str, Any]


@dataclass(slots=True)
class Page:
    """What one page was shown of one flight."""

    station: Station
    views: list[View] = field(default_factory=list)
    log: list[Any] = field(default_factory=list)
    results: list[Any] = field(default_factory=list)
    _flight: str = ""
    _seen: int = 0
    _missions: dict[str, Any] = field(default_factory=dict)
    _drones: dict[str, Any] = field(default_factory=dict)

    def look(self, instants: int | None = None) -> str:
        """Look until the flight has ended, or at so many instants; return its id."""

        def is_enough() -> bool:
            is_over = self._look_once()["phase"] in ENDS
            return is_over or len({view.t for view in self.views}) == instants

        until(is_enough, "the flight has ended")
        return self._flight.removesuffix(".journal")

    def _look_once(self) -> dict[str, Any]:
        """Take what has changed, as a page does; return the state of the station."""
        asked = f"flight={self._flight}&seen={self._seen}"
        given = self.station.get(
            f"/api/live?{asked}&log={len(self.log)}&results={len(self.results)}"
        )
        self._flight, self._seen = given["flight"], given["version" if "version" in given else "n"]
        self._missions.update((row["name"], row) for row in given["missions"])
        self._drones.update((row["id"], row) for row in given["drones"])
        self.log += given["log"]
        self.results += given["results"]
        state: dict[str, Any] = given["state"]
        now = View(
            t=state.pop("time"),
            state=state,
            missions=deepcopy(self._missions),
            drones=deepcopy(self._drones),
        )
        self.views.append(now)
        return state
