"""The table of all addresses: from it requests are answered, and the interface is described.

`openapi.json`, the pages' types and the Python client are made of it and of the types that it
names (`python -m station_interface`).
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from ..map.pictures import PICTURES
from ..requests import COMMANDS, ExampleEdit, PlanEdit, Said
from ..wire import (
    AreaAsked,
    DroneHours,
    FlightReport,
    FlightSummary,
    Forecast,
    ForecastRequest,
    LiveMessage,
    MapData,
    MapEdit,
    PlanOpened,
    PlanRestored,
    PlanSaved,
    Replay,
    Role,
    SavedPlans,
    Swept,
    Ways,
    WaysAsked,
)
from ..wire_app import AppData, PlanData
from . import changes, flights, forecasts, map_changes, plan_library, reads, results
from .http import Reply
from .live import LIVE
from .reads import TOML
from .served import Asked

JSON, TEXT = "application/json", "text/plain"

SMALL_BODY = 1024 * 1024
"""The most bytes of a body, where an address does not say that it takes more."""
LARGE_BODY = 20 * 1024 * 1024
"""The most bytes of a picture."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter in an address's query."""

    type: type[int | float | str]
    says: str
    needed: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Address:
    """One address under one method: who may ask it, what it takes, what it answers."""

    method: Literal["GET", "POST", "PUT", "DELETE"]
    path: str
    says: str
    answers: Any
    """The type of an answer in JSON, or the media type of another."""
    do: Callable[[Asked], Awaitable[Reply]] | None
    """Its handler; None for that of live updates, which the `Api` holds itself."""
    role: Role = "fly"
    body: Any = None
    """The type of a body in JSON, or the media types of others; None: there is no body."""
    most_bytes: int = SMALL_BODY
    query: Mapping[str, Parameter] = field(default_factory=dict)
    stale: Any = None
    """The type of the answer 409 to an edit of what has changed meanwhile, if not a sentence."""
    reads_flights: bool = False
    """Whether it reads files of flights, which may take a while."""
    always: bool = False
    """Whether it brings drones down, and so is exempt from all limits."""

    @property
    def name(self) -> str:
        """The name of what it does, for descriptions and clients."""
        if self.do is None or self.do is changes.command:
            return self.path.removeprefix("/api/").replace("-", "_")
        return self.do.__name__

    @property
    def media(self) -> Sequence[str]:
        """The media types of its body."""
        return self.body if isinstance(self.body, tuple) else (JSON,)


_REVISION = Parameter(int, "The revision of the plan that was looked at.", needed=True)
_ALWAYS = ("stop", "cut-motors")

_READS = (
    Address(
        method="GET",
        path="/api/app",
        says="The app with its fields, actions and graph, and the fleet.",
        answers=AppData,
        do=reads.app,
        role="watch",
    ),
    Address(
        method="GET",
        path=LIVE,
        says="What has changed since a version, as soon as anything has, or after a second.",
        answers=LiveMessage,
        do=None,
        role="watch",
        query={
            "flight": Parameter(str, "The flight that was seen last; empty: none."),
            "seen": Parameter(int, "The version that was seen."),
            "log": Parameter(int, "The number of the newest line that was seen."),
            "results": Parameter(int, "The number of the newest result that was seen."),
        },
    ),
    Address(
        method="GET",
        path="/api/plan",
        says="The plan, with all its problems.",
        answers=PlanData,
        do=reads.plan,
        role="watch",
    ),
    Address(
        method="GET",
        path="/api/plan.toml",
        says="The plan as a missions file.",
        answers=TOML,
        do=reads.plan_file,
        role="watch",
    ),
    Address(
        method="GET",
        path="/api/console.txt",
        says="What has happened in the flight, line by line.",
        answers=TEXT,
        do=flights.console,
        role="watch",
        reads_flights=True,
        query={"flight": Parameter(str, "The id of a flight of the past; left out: that of now.")},
    ),
    Address(
        method="GET",
        path="/api/openapi.json",
        says="This description.",
        answers=dict[str, object],
        do=reads.description,
        role="watch",
    ),
)

_EDITS = (
    Address(
        method="PUT",
        path="/api/plan",
        says="Replace the plan's missions, but for those that fly.",
        body=PlanEdit,
        answers=PlanData,
        stale=PlanData,
        do=changes.replace_plan,
    ),
    Address(
        method="POST",
        path="/api/plan/import",
        says="Replace the plan's missions by those of a missions file.",
        body=(TOML,),
        answers=PlanData,
        stale=PlanData,
        do=changes.import_plan,
        query={"revision": _REVISION, "file": Parameter(str, "The file's name, for messages.")},
    ),
    Address(
        method="POST",
        path="/api/plan/example",
        says="Add missions that this fleet can fly.",
        body=ExampleEdit,
        answers=PlanData,
        stale=PlanData,
        do=changes.add_example,
    ),
)

_MAP = (
    Address(
        method="GET",
        path="/api/map",
        says="The places and zones that have names, north, and where the floor plan lies.",
        answers=MapData,
        do=map_changes.map_data,
        role="watch",
    ),
    Address(
        method="PUT",
        path="/api/map",
        says="Keep what was drawn on the map in the fleet file; what is not sent stays.",
        body=MapEdit,
        answers=MapData,
        stale=MapData,
        do=map_changes.change_map,
    ),
    Address(
        method="PUT",
        path="/api/map/image",
        says="Take a picture as the floor plan.",
        body=tuple(dict.fromkeys(PICTURES.values())),
        most_bytes=LARGE_BODY,
        answers=MapData,
        stale=MapData,
        do=map_changes.take_floor_plan,
        query={
            "revision": Parameter(int, "The revision of the map that was looked at.", needed=True),
            "name": Parameter(str, "The file's name."),
        },
    ),
    Address(
        method="POST",
        path="/api/ways",
        says="The ways that drones fly between pairs of places, around walls.",
        body=WaysAsked,
        answers=Ways,
        do=map_changes.find_ways,
        role="watch",  # it changes nothing, and who watches sees where drones are bound
    ),
    Address(
        method="POST",
        path="/api/plan/sweep",
        says="The targets with which an area is covered, in their order.",
        body=AreaAsked,
        answers=Swept,
        do=map_changes.sweep_area,
    ),
)
_NAME = Parameter(str, "The name of a plan that is kept.", needed=True)
_PLANS = (
    Address(
        method="GET",
        path="/api/plans",
        says="The plans and templates that are kept under names, and those that were deleted.",
        answers=SavedPlans,
        do=plan_library.saved_plans,
        role="watch",
    ),
    Address(
        method="PUT",
        path="/api/plans",
        says="Keep the plan under a name.",
        body=PlanSaved,
        answers=SavedPlans,
        do=plan_library.save_plan,
        query={"name": _NAME},
    ),
    Address(
        method="DELETE",
        path="/api/plans",
        says="Put a plan that is kept into the trash.",
        answers=SavedPlans,
        do=plan_library.delete_plan,
        query={"name": _NAME},
    ),
    Address(
        method="POST",
        path="/api/plans/open",
        says="Take a plan that is kept in place of what has not been started, or beside it.",
        body=PlanOpened,
        answers=PlanData,
        stale=PlanData,
        do=plan_library.open_plan,
    ),
    Address(
        method="POST",
        path="/api/plans/restore",
        says="Take a plan out of the trash.",
        body=PlanRestored,
        answers=SavedPlans,
        do=plan_library.restore_plan,
    ),
)

_COMMANDS = tuple(
    Address(
        method="POST",
        path=f"/api/{name}",
        says=(body.__doc__ or "").partition("\n")[0],
        body=body,
        answers=Said,
        do=changes.command,
        always=name in _ALWAYS,
    )
    for name, body in COMMANDS.items()
)

_FLIGHT = Parameter(str, "The id of a flight, as the list of flights has it.", needed=True)
_FLIGHTS = (
    Address(
        method="GET",
        path="/api/flights",
        says="The flights of the past and that of now, the newest first.",
        answers=list[FlightSummary],
        do=flights.flights,
        role="watch",
        reads_flights=True,
    ),
    Address(
        method="GET",
        path="/api/flights/replay",
        says="A part of what pages were shown of a flight.",
        answers=Replay,
        do=flights.replay,
        role="watch",
        reads_flights=True,
        query={
            "flight": _FLIGHT,
            "start": Parameter(float, "From which second of the flight on; 0 if it is left out."),
        },
    ),
    Address(
        method="GET",
        path="/api/flights/report",
        says="What is to be said of a flight on paper.",
        answers=FlightReport,
        do=flights.report,
        role="watch",
        reads_flights=True,
        query={"flight": _FLIGHT},
    ),
    Address(
        method="GET",
        path="/api/flights/mcap",
        says="A flight as an MCAP file.",
        answers=flights.MCAP,
        do=flights.mcap,
        role="watch",
        reads_flights=True,
        query={"flight": _FLIGHT},
    ),
    Address(
        method="GET",
        path="/api/drones/hours",
        says="What each drone has flown, over all flights that are kept.",
        answers=list[DroneHours],
        do=flights.hours,
        role="watch",
        reads_flights=True,
    ),
)
_OF_FLIGHT = {"flight": Parameter(str, "The id of a flight of the past; left out: that of now.")}
_RESULTS = (
    Address(
        method="GET",
        path="/api/results.json",
        says="What a flight has brought, with full values.",
        answers=list[object],
        do=results.results,
        role="watch",
        reads_flights=True,
        query=_OF_FLIGHT,
    ),
    Address(
        method="GET",
        path="/api/results.csv",
        says="What a flight has brought, a row a value.",
        answers=results.CSV,
        do=results.results_table,
        role="watch",
        reads_flights=True,
        query=_OF_FLIGHT,
    ),
    Address(
        method="GET",
        path="/api/results.geojson",
        says="What a flight has brought, by places, in metres of the map.",
        answers=results.GEOJSON,
        do=results.results_on_map,
        role="watch",
        reads_flights=True,
        query=_OF_FLIGHT,
    ),
    Address(
        method="GET",
        path="/api/results.zip",
        says="The pictures that a flight has taken, with a table of them.",
        answers=results.ZIP,
        do=results.pictures,
        role="watch",
        reads_flights=True,
        query=_OF_FLIGHT,
    ),
    Address(
        method="GET",
        path="/api/photo",
        says="The picture of a photo, as it was taken or small.",
        answers=results.PICTURES,
        do=results.photo,
        role="watch",
        reads_flights=True,
        query={
            **_OF_FLIGHT,
            "result": Parameter(int, "The number of the result.", needed=True),
            "size": Parameter(str, "`thumb` for a small one."),
        },
    ),
)
_FORECASTS = (
    Address(
        method="POST",
        path="/api/preflight",
        says="What a Start would do, by many runs in virtual time.",
        body=ForecastRequest,
        answers=Forecast,
        do=forecasts.preflight,
    ),
)

ADDRESSES: Sequence[Address] = (
    *_READS,
    *_FLIGHTS,
    *_RESULTS,
    *_EDITS,
    *_MAP,
    *_PLANS,
    *_FORECASTS,
    *_COMMANDS,
)
