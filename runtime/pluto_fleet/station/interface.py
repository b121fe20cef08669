# mypy: disable-error-code="empty-body"
"""Every address of a station, each declared once as a method: what may be asked, with which values, by whom.

Of it requests are checked (`web/api.py`), the client is made (`client/`) and the interface is
described (`python -m station_interface`). What the methods answer is in `wire.py` and `wire_app.py`.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any, Literal

from msgspec import Meta

from .map.pictures import PICTURES
from .operation import JSON, LARGE_BODY, Operation, Whole, operation
from .wire import (
    Count,
    DroneHours,
    Flight,
    FlightReport,
    FlightSummary,
    Forecast,
    Laid,
    LiveMessage,
    MapData,
    Place,
    Point,
    Replay,
    SavedPlans,
    Swept,
    Ways,
    Zone,
)
from .wire_app import AppData, PlanData, PlanMission, PlanTrip

TEXT = "text/plain"
CSV = "text/csv"
TOML = "application/toml"
GEOJSON = "application/geo+json"
KML = "application/vnd.google-earth.kml+xml"
ZIP = "application/zip"
MCAP = "application/octet-stream"

Revision = Annotated[int, Meta(description="The revision of the plan that was looked at.")]
Missions = Annotated[list[str] | None, Meta(description="The keys of missions; null: all.")]
OnlyFailed = Annotated[
    bool | None,
    Meta(description="Whether trips that were done are left out of missions that failed."),
]
Mission = Annotated[str, Meta(description="The name of a mission.")]
Missing = Annotated[str | None, Meta(description="The name of a mission; null: all.")]
EventName = Annotated[str, Meta(description="The name of an event that the app declares.")]
Drone = Annotated[str, Meta(description="The id of a drone.")]
PlanName = Annotated[str, Meta(description="The name of a plan that is kept.")]
FlightId = Annotated[Flight, Meta(description="The id of a flight, as the list of flights has it.")]
PastFlight = Annotated[
    Flight, Meta(description="The id of a flight of the past; left out: that of now.")
]
Seconds = Annotated[float, Meta(ge=0, le=1e9, description="Seconds of the flight.")]
Keep = Annotated[float, Meta(ge=0, le=1e9, description="Seconds by the clock on the wall.")]
Length = str | Whole | float
"""Metres, or a text with a unit."""
Share = str | Whole | float
"""From 0 to 1, or a text with a percentage."""
Priority = Annotated[int, Meta(ge=-1_000_000_000, le=1_000_000_000)]

_watch = partial(operation, "GET", role="watch", reads=True)
_past = partial(_watch, reads_flights=True, impossible=404)
_edit = partial(operation, stale=PlanData)
_command = partial(operation, "POST")


class Interface:
    """What can be asked of a station; a command's `id` is taken by itself where none is given."""

    def ask(self, operation: Operation, given: Mapping[str, Any]) -> Any:
        """Ask an address with these arguments."""
        raise NotImplementedError

    @_watch("/api/app")
    def app(self) -> AppData:
        """The app with its fields, actions and graph, and the fleet."""

    @_watch("/api/live")
    def live(
        self, *, flight: Flight = "", seen: Count = 0, log: Count = 0, results: Count = 0
    ) -> LiveMessage:
        """What has changed since a version, as soon as anything has, or after a second."""

    @_watch("/api/plan")
    def plan(self) -> PlanData:
        """The plan, with all its problems."""

    @_watch("/api/plan.toml", media=TOML)
    def plan_file(self) -> str:
        """The plan as a missions file."""

    @_past("/api/console.txt", media=TEXT)
    def console(self, *, flight: PastFlight = "") -> str:
        """What has happened in the flight, line by line."""

    @_watch("/api/openapi.json")
    def description(self) -> dict[str, Any]:
        """This description."""

    # Flights of the past

    @_past("/api/flights")
    def flights(self) -> list[FlightSummary]:
        """The flights of the past and that of now, the newest first."""

    @_past("/api/flights/replay")
    def replay(self, *, flight: FlightId, start: Seconds = 0.0) -> Replay:
        """A part of what pages were shown of a flight, from a second of it on."""

    @_past("/api/flights/report")
    def report(self, *, flight: FlightId) -> FlightReport:
        """What is to be said of a flight on paper."""

    @_past("/api/flights/mcap", media=MCAP)
    def mcap(self, *, flight: FlightId) -> bytes:
        """A flight as an MCAP file."""

    @_past("/api/drones/hours")
    def hours(self) -> list[DroneHours]:
        """What each drone has flown, over all flights that are kept."""

    # Results

    @_past("/api/results.json")
    def results(self, *, flight: PastFlight = "") -> list[Any]:
        """What a flight has brought, with full values."""

    @_past("/api/results.csv", media=CSV)
    def results_table(self, *, flight: PastFlight = "") -> str:
        """What a flight has brought, a row a value."""

    @_past("/api/results.geojson", media=GEOJSON)
    def results_on_map(self, *, flight: PastFlight = "") -> str:
        """What a flight has brought, by places, in metres of the map."""

    @_past("/api/results.zip", media=ZIP)
    def pictures(self, *, flight: PastFlight = "") -> bytes:
        """The pictures that a flight has taken, with a table of them."""

    @_past("/api/photo", media="image/*")
    def photo(
        self, *, result: Count, flight: PastFlight = "", size: Literal["", "full", "thumb"] = ""
    ) -> bytes:
        """The picture of a photo, by the number of its result: as it was taken, or small."""

    # The plan

    @_edit("PUT", "/api/plan", impossible=400)
    def replace_plan(self, *, revision: Revision, missions: list[PlanMission]) -> PlanData:
        """Replace the plan's missions, but for those that fly."""

    @_edit("POST", "/api/plan/import", takes=(TOML, GEOJSON, KML, JSON, CSV), impossible=400)
    def import_plan(self, body: str | bytes, *, revision: Revision, file: str = "") -> PlanData:
        """Replace the plan's missions by those of a missions file, or a drawing; its name is used in messages."""

    @_edit("POST", "/api/plan/example")
    def add_example(self, *, revision: Revision) -> PlanData:
        """Add missions that this fleet can fly."""

    @_watch("/api/plans")
    def saved_plans(self) -> SavedPlans:
        """The plans and templates that are kept under names, and those that were deleted."""

    @operation("PUT", "/api/plans", in_query=("name",))
    def save_plan(
        self, *, name: PlanName, by: str = "", template: bool = False, replace: bool = False
    ) -> SavedPlans:
        """Keep the plan under a name; one that has the name already goes to the trash, or is kept."""

    @operation("DELETE", "/api/plans")
    def delete_plan(self, *, name: PlanName) -> SavedPlans:
        """Put a plan that is kept into the trash."""

    @_edit("POST", "/api/plans/open")
    def open_plan(self, *, name: PlanName, revision: Revision, add: bool = False) -> PlanData:
        """Take a plan that is kept in place of what has not been started, or beside it."""

    @operation("POST", "/api/plans/restore")
    def restore_plan(self, *, id: str) -> SavedPlans:
        """Take a plan out of the trash."""

    @operation("POST", "/api/preflight", reads=True)
    def preflight(
        self,
        *,
        revision: Revision,
        missions: Missions = None,
        only_failed: OnlyFailed = None,
        runs: int | None = None,
    ) -> Forecast:
        """What a Start would do, by many runs in virtual time."""

    # The map

    @_watch("/api/map")
    def map_data(self) -> MapData:
        """The places and zones that have names, north, and where the floor plan lies."""

    @operation("PUT", "/api/map", stale=MapData, impossible=400)
    def change_map(
        self,
        *,
        revision: int,
        places: list[Place] | None = None,
        zones: list[Zone] | None = None,
        north: Whole | float | None = None,
        image: Laid | None = None,
    ) -> MapData:
        """Keep what was drawn on the map in the fleet file; what is not sent stays.

        `image` is where the floor plan lies; if null is sent, there is to be none.
        """

    @operation(
        "PUT",
        "/api/map/image",
        takes=tuple(dict.fromkeys(PICTURES.values())),
        most_bytes=LARGE_BODY,
        stale=MapData,
        impossible=400,
    )
    def take_floor_plan(self, body: bytes, *, media: str, revision: int, name: str = "") -> MapData:
        """Take a picture as the floor plan."""

    @operation(
        "PUT",
        "/api/map/drawing",
        takes=(GEOJSON, KML, JSON, CSV),
        stale=MapData,
        impossible=400,
    )
    def take_drawing(self, body: str | bytes, *, revision: int, file: str = "") -> MapData:
        """Keep the places and zones of another program's drawing; `said` is what that was."""

    @operation("POST", "/api/ways", role="watch", reads=True, impossible=400)
    def find_ways(self, *, ways: Annotated[list[list[Point]], Meta(max_length=500)]) -> Ways:
        """The ways that drones fly between pairs of places, around walls."""

    @operation("POST", "/api/plan/sweep", reads=True, impossible=400)
    def sweep_area(
        self,
        *,
        polygon: list[Point],
        spacing: Length | None = None,
        overlap: Share | None = None,
        height: Length | None = None,
        before: Point | None = None,
        action: str | None = None,
        on_the_way: bool = False,
    ) -> Swept:
        """The trips with which an area is covered, in their order, by drones that come from `before`.

        With a `spacing`, or the `overlap` that photos are to have. `on_the_way`: lines, on which the action is done
        without a stop.
        """

    # Commands

    @_command("/api/start")
    def start(
        self,
        *,
        revision: int | None = None,
        missions: Missions = None,
        only_failed: OnlyFailed = None,
        id: str | None = None,
    ) -> str:
        """Fly missions of the plan: all that have not been completed, or all again, if none are named."""

    @_command("/api/stop", always=True)
    def stop(self, *, how: Literal["rtl", "land"], id: str | None = None) -> str:
        """Bring all drones down at once: home first (`rtl`), or where they are (`land`)."""

    @_command("/api/resume")
    def resume(self, *, id: str | None = None) -> str:
        """Go on with a flight that was stopped or interrupted."""

    @_command("/api/discard")
    def discard(self, *, id: str | None = None) -> str:
        """Put a flight away that was stopped or interrupted; its journal stays."""

    @_command("/api/pause")
    def pause(self, *, mission: Missing = None, id: str | None = None) -> str:
        """Call a mission's drone home until it goes on."""

    @_command("/api/go-on")
    def go_on(self, *, mission: Missing = None, id: str | None = None) -> str:
        """Let a paused mission go on."""

    @_command("/api/skip")
    def skip(self, *, mission: Mission, trip: str | None = None, id: str | None = None) -> str:
        """Leave a trip out; null: the next one."""

    @_command("/api/cancel")
    def cancel(self, *, mission: Missing = None, id: str | None = None) -> str:
        """End a mission for good."""

    @_command("/api/decide")
    def decide(self, *, mission: Mission, answer: str, id: str | None = None) -> str:
        """Answer the question of a mission."""

    @_command("/api/change-trips")
    def change_trips(
        self,
        *,
        mission: Mission,
        trips: list[PlanTrip],
        replaces: list[str] | None = None,
        id: str | None = None,
    ) -> str:
        """Change what has not flown of a mission that is under way.

        `trips` are all that is to be flown from now on, but for the trip that flies; `replaces` are the names
        of the trips that were seen to wait: others are refused.
        """

    @_command("/api/prioritise")
    def prioritise(
        self, *, mission: Mission, trip: str, priority: Priority, id: str | None = None
    ) -> str:
        """Change the priority of a trip."""

    @_command("/api/events/{event}")
    def raise_event(
        self,
        *,
        event: EventName,
        at: list[float] | None = None,
        track: str | None = None,
        mission: str | None = None,
        trip: str | None = None,
        drone: str | None = None,
        fields: dict[str, Any] | None = None,
        keep: Keep | None = None,
        id: str | None = None,
    ) -> str:
        """Raise an event of the app, with the fields that it declares; with one `id` it happens once.

        While everything is stopped it is kept for `keep` seconds, 60 if that is null.
        """

    @_command("/api/retire")
    def retire(self, *, drone: Drone, id: str | None = None) -> str:
        """Give a drone to no mission any more, once its trip is done."""

    @_command("/api/bring-back")
    def bring_back(self, *, drone: Drone, id: str | None = None) -> str:
        """Say that a lost or retired drone can fly again."""

    @_command("/api/join")
    def join(
        self,
        *,
        drone: Drone,
        category: str | None = None,
        home: Point | None = None,
        uri: str | None = None,
        navigation: str | None = None,
        options: dict[str, Any] | None = None,
        parameters: dict[str, Any] | None = None,
        id: str | None = None,
    ) -> str:
        """Let a drone join the flight that is under way, as an entry of a fleet file says it."""

    @_command("/api/mishap")
    def mishap(
        self,
        *,
        drone: Drone,
        kind: Literal["lost", "crash", "battery", "uncertain"],
        id: str | None = None,
    ) -> str:
        """Let something go wrong with a simulated drone, to rehearse it."""

    @_command("/api/cut-motors", always=True)
    def cut_motors(self, *, drone: Drone, id: str | None = None) -> str:
        """Switch a drone's motors off at once: if it flies, it falls."""

    @_command("/api/acknowledge")
    def acknowledge(self, *, alert: str, id: str | None = None) -> str:
        """Say that a person knows of an alert."""
