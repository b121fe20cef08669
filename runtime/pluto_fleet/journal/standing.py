"""Where everything stands, by the rows of a journal: missions with their trips, drones, results, the app.

Rows are plain data, as the brain gives them; nothing is computed here from what has happened.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

Record = dict[str, Any]
"""A mission's row, with those of its trips in `todo`, `done` and `gone`."""

Row = tuple[str, tuple[str | int, ...], Mapping[str, Any]]
"""Its table, its key there, and what it holds."""

REMEMBERED = 200
"""How many command ids are remembered: older ones are not repeated."""


class Standing:
    """All rows of one journal, as far as they are known."""

    def __init__(self, rows: Iterable[Row] = (), time: float = 0.0) -> None:
        self.time = time
        """When something happened last, in seconds since the app first started."""
        self.missions: dict[str, Record] = {}
        self.drones: dict[str, Record] = {}
        self.results: list[Record] = []
        self.happenings: dict[str, Record] = {}
        """The events that were raised, by their ids."""
        self.app: Record = {"clock": {"began": None, "drift": 0.0}, "stopped": None}
        self._trips: dict[str, dict[int, Record]] = {}
        self.take(rows)

    def take(self, rows: Iterable[Row]) -> None:
        """Take over rows in place of those with the same keys."""
        changed: dict[str, None] = {}
        for table, key, row in rows:
            match table, key:
                case "mission", (str(name),):
                    self.missions[name] = dict(row)
                    changed[name] = None
                case "trip", (str(name), int(number)):
                    self._trips.setdefault(name, {})[number] = dict(row)
                    changed[name] = None
                case "drone", (str(id),):
                    self.drones[id] = dict(row)
                case "result", (int(number),):
                    del self.results[number:]
                    self.results.append(dict(row))
                case "happening", (str(id),):
                    self.happenings[id] = dict(row)
                case "app", (str(fact),):
                    self.app[fact] = row["is"]
        for name in changed:
            if name in self.missions:
                self._list_trips(name)

    def _list_trips(self, name: str) -> None:
        lists: dict[str, list[Record]] = {"todo": [], "done": [], "gone": []}
        for trip in self._trips.get(name, {}).values():
            which = "done" if trip.get("status") == "COMPLETED" else "todo"
            lists["gone" if "round" in trip else which].append(trip)
        for trips in lists.values():
            trips.sort(key=_rank)
        self.missions[name].update(lists)

    @property
    def data(self) -> Record:
        """All of it, as a brain takes it to go on."""
        return {
            "missions": self.missions,
            "drones": self.drones,
            "results": self.results,
            "happenings": self.happenings,
        }

    def row_of(self, mission: str) -> Record:
        """Return the row of a mission alone."""
        lists = ("todo", "done", "gone")
        return {fact: one for fact, one in self.missions[mission].items() if fact not in lists}

    # The app

    @property
    def stopped(self) -> bool:
        """Whether everything was stopped by a command, and not resumed since."""
        return self.app["stopped"] is not None

    @property
    def clock(self) -> Record:
        """When the app first began, by the clock of the hours, and how far that has drifted since."""
        found: Record = self.app["clock"]
        return found

    @property
    def commands(self) -> list[str]:
        """The ids of the last commands, as chosen by their senders."""
        return list(self.app.get("commands", ()))

    @property
    def joined(self) -> list[Record]:
        """The drones that have joined the fleet, in their order, each as in a fleet file."""
        return list(self.app.get("joined", ()))

    @property
    def kept(self) -> list[Record]:
        """The events that were raised while everything was stopped, to be told at Resume."""
        return list(self.app.get("kept", ()))

    # Drones

    @property
    def lost(self) -> dict[str, Record]:
        """The drones that no trip may have before a person has looked after them: why, and where."""
        return {id: row["lost"] for id, row in self.drones.items() if row.get("lost")}

    @property
    def retired(self) -> list[str]:
        """The retired drones."""
        return [id for id, row in self.drones.items() if row.get("retired")]

    @property
    def mended(self) -> list[str]:
        """The drones that were lost and repaired, and are not back yet."""
        return [id for id, row in self.drones.items() if row.get("mended")]

    @property
    def flown(self) -> dict[str, int]:
        """How many trips each drone has flown."""
        return {id: row.get("trips", 0) for id, row in self.drones.items()}

    @property
    def needed(self) -> set[str]:
        """The drones that missions have which have not ended, without those that have joined."""
        living = [record for record in self.missions.values() if not record["ended"]]
        flown = {record["flight"]["drone"] for record in living if record["flight"] is not None}
        carriers = {record["carrier"] for record in living if record["carrier"] is not None}
        return (flown | carriers) - {str(entry.get("id")) for entry in self.joined}

    def with_drone(self, id: str, **facts: object) -> Row:
        """Change a drone's row, and return it."""
        row = self.drones[id] = {**self.drones.get(id, {}), **facts}
        return "drone", (id,), row

    def lose(self, id: str, reason: str, at: object) -> Row:
        """Note that a drone is lost; if it already was, the first reason counts."""
        known = self.drones.get(id, {}).get("lost")
        return self.with_drone(id, lost=known or {"reason": reason, "at": at}, mended=False)

    def bring_back(self, id: str) -> Row:
        """Note that a person has looked after a drone."""
        row = self.drones.get(id, {})
        mended = bool(row.get("lost") or row.get("mended"))
        return self.with_drone(id, lost=None, retired=False, mended=mended)


def inherited(facts: Mapping[str, Any]) -> list[Row]:
    """Return the rows of a new journal: what is known of its drones by earlier flights."""
    standing = Standing()
    for id, loss in (facts.get("lost") or {}).items():
        standing.lose(id, loss["reason"], loss.get("at"))
    for id in facts.get("mended") or ():
        standing.with_drone(id, mended=True)
    for id in facts.get("retired") or ():
        standing.with_drone(id, retired=True)
    rows: list[Row] = [("drone", (id,), row) for id, row in standing.drones.items()]
    if facts.get("joined"):
        rows.append(("app", ("joined",), {"is": facts["joined"]}))
    return rows


def _rank(trip: Record) -> int:
    rank: int = trip.get("rank", 0)
    return rank
