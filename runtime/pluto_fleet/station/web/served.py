"""The station as the HTTP interface needs it, and a request that was let in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ..wire import Role
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

    def export_toml(self) -> str:
        """Return it as a missions file."""


class ServedStation(UpdateSource, Protocol):
    """The station that is served."""

    @property
    def plan(self) -> ServedPlan:
        """The plan."""

    @property
    def image(self) -> Path | None:
        """The floor plan."""

    @property
    def described(self) -> AppData:
        """Return the constant data of app and fleet."""

    async def command(self, name: str, id: str, given: Mapping[str, object], by: str, /) -> str:
        """Carry out a command of a person, unless it was carried out with this id before.

        `by` is the person's name, or empty. Raise `BadInput` if it cannot be done.
        """

    def console(self) -> str:
        """Return the console."""

    def results(self) -> list[object]:
        """Return the results."""


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
