"""A page that looks at a flight until its end, and keeps all that it was shown."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any

from tests.station.browser.serving import Station, until

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

    def look_until_its_end(self) -> str:
        """Look until the flight has ended; return its name."""
        seen: dict[str, Any] = {"flight": "", "seen": 0}
        missions: dict[str, Any] = {}
        drones: dict[str, Any] = {}
        state: dict[str, Any] = {}

        def is_over() -> bool:
            nonlocal state
            asked = f"flight={seen['flight']}&seen={seen['seen']}"
            given = self.station.get(
                f"/api/live?{asked}&log={len(self.log)}&results={len(self.results)}"
            )
            seen.update(flight=given["flight"], seen=given.get("version", given.get("n")))
            missions.update((row["name"], row) for row in given["missions"])
            drones.update((row["id"], row) for row in given["drones"])
            self.log += given["log"]
            self.results += given["results"]
            state = given["state"]
            self.views.append(
                View(
                    t=state.pop("time"),
                    state=state,
                    missions=deepcopy(missions),
                    drones=deepcopy(drones),
                )
            )
            return state["phase"] in ENDS

        until(is_over, "the flight has ended")
        return str(seen["flight"])
