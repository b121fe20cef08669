"""The station as the HTTP interface needs it, and a request that was let in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ...process.apart import Answers
from ..flight_files import FlightFiles
from ..map.drawn import DrawnMap
from ..map.ways import DrawnWays
from ..plan.library import PlanLibrary
from ..plan.shape import Shape
from ..preflight.start import PlannedStart
from ..wire import Forecast, Role
from ..wire_app import AppData
from .audit import Audit
from .http import Request
from .live import UpdateSource


class ServedPlan(Protocol):
    """The plan; each change names the revision that it was made on, and raises `Stale` if that is old."""

    def data(self) -> Mapping[str, object]:
        """Return the plan with its known problems."""

    async def examined(self) -> None:
        """Wait until all its problems are known."""

    def replace(self, revision: int, missions: object) -> None:
        """Replace its missions."""

    async def import_file(self, text: str, revision: int, file: str) -> None:
        """Replace its missions by those of a file, whose name is used in messages."""

    def example(self, revision: int) -> None:
        """Add an example."""

    def saved(self, text: str, file: str) -> tuple[list[Shape], str]:
        """Return the missions of a plan that was kept, and what is to be done before it can fly."""

    def add(self, read: Sequence[Shape], revision: object) -> None:
        """Add missions that have no keys."""

    def take_instead(self, read: Sequence[Shape], revision: object) -> None:
        """Replace its missions by these, which have no keys."""

    def export_toml(self) -> str:
        """Return it as a missions file."""


class ServedResults(Protocol):
    """The results that are served. `flight` is an id, or empty for the current flight."""

    async def results(self, flight: str) -> str:
        """Return the results as JSON."""

    async def csv(self, flight: str) -> str:
        """Return the table of values."""

    async def geojson(self, flight: str) -> str:
        """Return the results that have a place, as GeoJSON."""

    async def archive(self, flight: str) -> Path:
        """Write an archive of the pictures into a file, which the caller deletes."""

    async def picture(self, flight: str, number: int, *, small: bool) -> tuple[bytes, str]:
        """Return the picture of a result and its media type."""


class ServedStation(UpdateSource, Protocol):
    """The station that is served."""

    @property
    def plan(self) -> ServedPlan:
        """The plan."""

    @property
    def map(self) -> DrawnMap:
        """What is drawn on the map."""

    @property
    def ways(self) -> DrawnWays:
        """The ways of drones on it."""

    @property
    def library(self) -> PlanLibrary:
        """The plans that are kept under names."""

    @property
    def image(self) -> Path | None:
        """The floor plan."""

    @property
    def files(self) -> Answers[FlightFiles]:
        """What reads the files of flights; it raises `BadInput` if there is none of an id."""

    @property
    def described(self) -> AppData:
        """Return the constant data of app and fleet."""

    async def edit(self, revision: int, missions: object, /) -> None:
        """Replace the plan by a page's; raise `Stale` or `BadInput` if that cannot be."""

    async def command(self, name: str, id: str, given: Mapping[str, object], by: str, /) -> str:
        """Carry out a command of a person, unless it was carried out with this id before.

        `by` is the person's name, or empty. Raise `BadInput` if it cannot be done.
        """

    async def forecast(self, asked: PlannedStart, /) -> Forecast:
        """Return what a Start would do; raise `BadInput` if there is no forecast to make."""

    def console(self) -> str:
        """Return the console."""

    @property
    def exports(self) -> ServedResults:
        """The results of all flights."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """A request that was let in, with its body."""

    station: ServedStation
    audit: Audit
    request: Request
    role: Role
    given: dict[str, object]
    """The object in a body of JSON; empty for other bodies."""
    body: bytes
