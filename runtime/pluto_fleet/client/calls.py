"""Every address of a station as a method; made by `python -m tests.station.schema`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from .connection import Connection

if TYPE_CHECKING:
    from ..station.wire import LiveMessage
    from ..station.wire_app import AppData, PlanData, PlanMission


class Calls(Connection):
    """What can be asked of a station."""

    def app(self) -> AppData:
        """The app with its fields, actions and graph, and the fleet."""
        answer: AppData = self._json("GET", "/api/app")
        return answer

    def live(
        self, *, flight: str = "", seen: int = 0, log: int = 0, results: int = 0
    ) -> LiveMessage:
        """What has changed since a version, as soon as anything has, or after a second."""
        answer: LiveMessage = self._json(
            "GET",
            "/api/live",
            query={"flight": flight, "seen": seen, "log": log, "results": results},
        )
        return answer

    def plan(self) -> PlanData:
        """The plan, with all its problems."""
        answer: PlanData = self._json("GET", "/api/plan")
        return answer

    def plan_file(self) -> str:
        """The plan as a missions file."""
        return self._text("GET", "/api/plan.toml")

    def console(self) -> str:
        """What has happened in the flight, line by line."""
        return self._text("GET", "/api/console.txt")

    def results(self) -> list[object]:
        """What the flight has brought, with full values."""
        answer: list[object] = self._json("GET", "/api/results.json")
        return answer

    def description(self) -> dict[str, object]:
        """This description."""
        answer: dict[str, object] = self._json("GET", "/api/openapi.json")
        return answer

    def replace_plan(self, *, revision: int, missions: list[PlanMission]) -> PlanData:
        """Replace the plan's missions, but for those that fly."""
        answer: PlanData = self._json(
            "PUT", "/api/plan", body={"revision": revision, "missions": missions}
        )
        return answer

    def import_plan(self, body: str | bytes, *, revision: int, file: str = "") -> PlanData:
        """Replace the plan's missions by those of a missions file."""
        answer: PlanData = self._sent(
            "POST",
            "/api/plan/import",
            {"revision": revision, "file": file},
            body,
            "application/toml",
        )
        return answer

    def add_example(self, *, revision: int) -> PlanData:
        """Add missions that this fleet can fly."""
        answer: PlanData = self._json("POST", "/api/plan/example", body={"revision": revision})
        return answer

    def start(
        self,
        *,
        id: str | None = None,
        revision: int | None = None,
        missions: list[str] | None = None,
    ) -> str:
        """Fly missions of the plan."""
        return self._command("/api/start", id, {"revision": revision, "missions": missions})

    def stop(self, *, how: Literal["rtl", "land"], id: str | None = None) -> str:
        """Bring all drones down at once."""
        return self._command("/api/stop", id, {"how": how})

    def resume(self, *, id: str | None = None) -> str:
        """Go on with a flight that was stopped or interrupted."""
        return self._command("/api/resume", id, {})

    def discard(self, *, id: str | None = None) -> str:
        """Put a flight away that was stopped or interrupted; its journal stays."""
        return self._command("/api/discard", id, {})

    def pause(self, *, id: str | None = None, mission: str | None = None) -> str:
        """Call a mission's drone home until it goes on."""
        return self._command("/api/pause", id, {"mission": mission})

    def go_on(self, *, id: str | None = None, mission: str | None = None) -> str:
        """Let a paused mission go on."""
        return self._command("/api/go-on", id, {"mission": mission})

    def skip(self, *, mission: str, id: str | None = None, trip: str | None = None) -> str:
        """Leave a trip out."""
        return self._command("/api/skip", id, {"mission": mission, "trip": trip})

    def cancel(self, *, id: str | None = None, mission: str | None = None) -> str:
        """End a mission for good."""
        return self._command("/api/cancel", id, {"mission": mission})

    def decide(self, *, mission: str, answer: str, id: str | None = None) -> str:
        """Answer the question of a mission."""
        return self._command("/api/decide", id, {"mission": mission, "answer": answer})

    def prioritise(self, *, mission: str, trip: str, priority: int, id: str | None = None) -> str:
        """Change the priority of a trip."""
        return self._command(
            "/api/prioritise", id, {"mission": mission, "trip": trip, "priority": priority}
        )

    def retire(self, *, drone: str, id: str | None = None) -> str:
        """Give a drone to no mission any more, once its trip is done."""
        return self._command("/api/retire", id, {"drone": drone})

    def bring_back(self, *, drone: str, id: str | None = None) -> str:
        """Say that a lost or retired drone can fly again."""
        return self._command("/api/bring-back", id, {"drone": drone})

    def cut_motors(self, *, drone: str, id: str | None = None) -> str:
        """Switch a drone's motors off at once: if it flies, it falls."""
        return self._command("/api/cut-motors", id, {"drone": drone})

    def acknowledge(self, *, alert: str, id: str | None = None) -> str:
        """Say that a person knows of an alert."""
        return self._command("/api/acknowledge", id, {"alert": alert})
