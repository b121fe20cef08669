"""Every address of a station as a method; made by `python -m station_interface`."""

from __future__ import annotations

from typing import Literal

from ..station.wire import (
    DroneHours,
    FlightReport,
    FlightSummary,
    Forecast,
    Laid,
    LiveMessage,
    MapData,
    Place,
    Replay,
    SavedPlans,
    Swept,
    Ways,
    Zone,
)
from ..station.wire_app import AppData, PlanData, PlanMission, PlanTrip
from .connection import Connection


class Calls(Connection):
    """What can be asked of a station."""

    def app(self) -> AppData:
        """The app with its fields, actions and graph, and the fleet."""
        answer: AppData = self._json("GET", "/api/app", wanted=AppData)
        return answer

    def live(
        self, *, flight: str = "", seen: int = 0, log: int = 0, results: int = 0
    ) -> LiveMessage:
        """What has changed since a version, as soon as anything has, or after a second."""
        answer: LiveMessage = self._json(
            "GET",
            "/api/live",
            query={"flight": flight, "seen": seen, "log": log, "results": results},
            wanted=LiveMessage,
        )
        return answer

    def plan(self) -> PlanData:
        """The plan, with all its problems."""
        answer: PlanData = self._json("GET", "/api/plan", wanted=PlanData)
        return answer

    def plan_file(self) -> str:
        """The plan as a missions file."""
        return self._text("GET", "/api/plan.toml")

    def console(self, *, flight: str = "") -> str:
        """What has happened in the flight, line by line."""
        return self._text("GET", "/api/console.txt", {"flight": flight})

    def description(self) -> dict[str, object]:
        """This description."""
        answer: dict[str, object] = self._json("GET", "/api/openapi.json", wanted=dict[str, object])
        return answer

    def flights(self) -> list[FlightSummary]:
        """The flights of the past and that of now, the newest first."""
        answer: list[FlightSummary] = self._json("GET", "/api/flights", wanted=list[FlightSummary])
        return answer

    def replay(self, *, flight: str, start: float = 0.0) -> Replay:
        """A part of what pages were shown of a flight."""
        answer: Replay = self._json(
            "GET", "/api/flights/replay", query={"flight": flight, "start": start}, wanted=Replay
        )
        return answer

    def report(self, *, flight: str) -> FlightReport:
        """What is to be said of a flight on paper."""
        answer: FlightReport = self._json(
            "GET", "/api/flights/report", query={"flight": flight}, wanted=FlightReport
        )
        return answer

    def mcap(self, *, flight: str) -> bytes:
        """A flight as an MCAP file."""
        return self._bytes("GET", "/api/flights/mcap", {"flight": flight})

    def hours(self) -> list[DroneHours]:
        """What each drone has flown, over all flights that are kept."""
        answer: list[DroneHours] = self._json("GET", "/api/drones/hours", wanted=list[DroneHours])
        return answer

    def results(self, *, flight: str = "") -> list[object]:
        """What a flight has brought, with full values."""
        answer: list[object] = self._json(
            "GET", "/api/results.json", query={"flight": flight}, wanted=list[object]
        )
        return answer

    def results_table(self, *, flight: str = "") -> str:
        """What a flight has brought, a row a value."""
        return self._text("GET", "/api/results.csv", {"flight": flight})

    def results_on_map(self, *, flight: str = "") -> str:
        """What a flight has brought, by places, in metres of the map."""
        return self._text("GET", "/api/results.geojson", {"flight": flight})

    def pictures(self, *, flight: str = "") -> bytes:
        """The pictures that a flight has taken, with a table of them."""
        return self._bytes("GET", "/api/results.zip", {"flight": flight})

    def photo(self, *, flight: str = "", result: int, size: str = "") -> bytes:
        """The picture of a photo, as it was taken or small."""
        return self._bytes("GET", "/api/photo", {"flight": flight, "result": result, "size": size})

    def replace_plan(self, *, revision: int, missions: list[PlanMission]) -> PlanData:
        """Replace the plan's missions, but for those that fly."""
        answer: PlanData = self._json(
            "PUT", "/api/plan", body={"revision": revision, "missions": missions}, wanted=PlanData
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
            wanted=PlanData,
        )
        return answer

    def add_example(self, *, revision: int) -> PlanData:
        """Add missions that this fleet can fly."""
        answer: PlanData = self._json(
            "POST", "/api/plan/example", body={"revision": revision}, wanted=PlanData
        )
        return answer

    def map_data(self) -> MapData:
        """The places and zones that have names, north, and where the floor plan lies."""
        answer: MapData = self._json("GET", "/api/map", wanted=MapData)
        return answer

    def change_map(
        self,
        *,
        revision: int,
        places: list[Place] | None = None,
        zones: list[Zone] | None = None,
        north: float | None = None,
        image: Laid | None = None,
    ) -> MapData:
        """Keep what was drawn on the map in the fleet file; what is not sent stays."""
        answer: MapData = self._json(
            "PUT",
            "/api/map",
            body={
                "revision": revision,
                "places": places,
                "zones": zones,
                "north": north,
                "image": image,
            },
            wanted=MapData,
        )
        return answer

    def take_floor_plan(
        self, body: str | bytes, *, media: str, revision: int, name: str = ""
    ) -> MapData:
        """Take a picture as the floor plan."""
        answer: MapData = self._sent(
            "PUT",
            "/api/map/image",
            {"revision": revision, "name": name},
            body,
            media,
            wanted=MapData,
        )
        return answer

    def find_ways(self, *, ways: list[list[list[float]]]) -> Ways:
        """The ways that drones fly between pairs of places, around walls."""
        answer: Ways = self._json("POST", "/api/ways", body={"ways": ways}, wanted=Ways)
        return answer

    def sweep_area(
        self,
        *,
        polygon: list[list[float]],
        spacing: str | float,
        height: str | float | None = None,
        before: list[float] | None = None,
    ) -> Swept:
        """The targets with which an area is covered, in their order."""
        answer: Swept = self._json(
            "POST",
            "/api/plan/sweep",
            body={"polygon": polygon, "spacing": spacing, "height": height, "before": before},
            wanted=Swept,
        )
        return answer

    def saved_plans(self) -> SavedPlans:
        """The plans and templates that are kept under names, and those that were deleted."""
        answer: SavedPlans = self._json("GET", "/api/plans", wanted=SavedPlans)
        return answer

    def save_plan(
        self,
        *,
        name: str,
        by: str | None = None,
        template: bool | None = None,
        replace: bool | None = None,
    ) -> SavedPlans:
        """Keep the plan under a name."""
        answer: SavedPlans = self._json(
            "PUT",
            "/api/plans",
            query={"name": name},
            body={"by": by, "template": template, "replace": replace},
            wanted=SavedPlans,
        )
        return answer

    def delete_plan(self, *, name: str) -> SavedPlans:
        """Put a plan that is kept into the trash."""
        answer: SavedPlans = self._json(
            "DELETE", "/api/plans", query={"name": name}, wanted=SavedPlans
        )
        return answer

    def open_plan(self, *, name: str, revision: int, add: bool | None = None) -> PlanData:
        """Take a plan that is kept in place of what has not been started, or beside it."""
        answer: PlanData = self._json(
            "POST",
            "/api/plans/open",
            body={"name": name, "revision": revision, "add": add},
            wanted=PlanData,
        )
        return answer

    def restore_plan(self, *, id: str | None = None) -> SavedPlans:
        """Take a plan out of the trash."""
        answer: SavedPlans = self._json("POST", "/api/plans/restore", body={}, wanted=SavedPlans)
        return answer

    def preflight(
        self,
        *,
        revision: int,
        missions: list[str] | None,
        only_failed: bool | None = None,
        runs: int | None = None,
    ) -> Forecast:
        """What a Start would do, by many runs in virtual time."""
        answer: Forecast = self._json(
            "POST",
            "/api/preflight",
            body={
                "revision": revision,
                "missions": missions,
                "only_failed": only_failed,
                "runs": runs,
            },
            wanted=Forecast,
        )
        return answer

    def start(
        self,
        *,
        id: str | None = None,
        revision: int | None = None,
        missions: list[str] | None = None,
        only_failed: bool | None = None,
    ) -> str:
        """Fly missions of the plan."""
        return self._command(
            "/api/start",
            id,
            {"revision": revision, "missions": missions, "only_failed": only_failed},
        )

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

    def change_trips(
        self,
        *,
        mission: str,
        trips: list[PlanTrip],
        id: str | None = None,
        replaces: list[str] | None = None,
    ) -> str:
        """Change what has not flown of a mission that is under way."""
        return self._command(
            "/api/change-trips", id, {"mission": mission, "trips": trips, "replaces": replaces}
        )

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

    def join(
        self,
        *,
        drone: str,
        id: str | None = None,
        category: str | None = None,
        home: list[float] | None = None,
        uri: str | None = None,
        navigation: str | None = None,
        options: dict[str, str | int | float | bool] | None = None,
        parameters: dict[str, str | int | float | bool] | None = None,
    ) -> str:
        """Let a drone join the flight that is under way, as an entry of a fleet file says it."""
        return self._command(
            "/api/join",
            id,
            {
                "drone": drone,
                "category": category,
                "home": home,
                "uri": uri,
                "navigation": navigation,
                "options": options,
                "parameters": parameters,
            },
        )

    def mishap(
        self,
        *,
        drone: str,
        kind: Literal["lost", "crash", "battery", "uncertain"],
        id: str | None = None,
    ) -> str:
        """Let something go wrong with a simulated drone, to rehearse it."""
        return self._command("/api/mishap", id, {"drone": drone, "kind": kind})

    def cut_motors(self, *, drone: str, id: str | None = None) -> str:
        """Switch a drone's motors off at once: if it flies, it falls."""
        return self._command("/api/cut-motors", id, {"drone": drone})

    def acknowledge(self, *, alert: str, id: str | None = None) -> str:
        """Say that a person knows of an alert."""
        return self._command("/api/acknowledge", id, {"alert": alert})
