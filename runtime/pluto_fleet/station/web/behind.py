"""What the server asks of what is behind it: a station, and the plan that people draw."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol


class Plan(Protocol):
    """The plan; each change names the revision that it was made on, and another is `Stale`."""

    def data(self) -> Mapping[str, object]:
        """Return all of it, and what is known to be wrong with it."""

    async def examined(self) -> None:
        """Wait until all is known that is wrong with it."""

    def replace(self, revision: int, missions: object) -> None:
        """Put missions in its place."""

    async def import_file(self, text: str, revision: int, file: str) -> None:
        """Put those of a missions file in its place; what is wrong with it says its name."""

    def example(self, revision: int) -> None:
        """Put an example in its place."""

    def export_toml(self) -> str:
        """Return it as a missions file."""


class Newest(Protocol):
    """Where one hears what has changed."""

    async def newer(self, flight: str, seen: int, log: int, results: int) -> str:
        """Return what is newer than what was seen, as JSON; wait for it, but not for long."""


class Station(Newest, Protocol):
    """What flies, what everybody sees, and what may be commanded."""

    @property
    def plan(self) -> Plan:
        """The plan that people draw."""

    @property
    def image(self) -> Path | None:
        """The floor plan."""

    @property
    def described(self) -> Mapping[str, object]:
        """What never changes while the server lives."""

    async def command(self, name: str, id: str, given: Mapping[str, object], /) -> str:
        """Do it, unless it was done by this id before; `BadInput` says why not."""

    def console(self) -> str:
        """Return all that was said."""

    def results(self) -> list[object]:
        """Return all that came of actions."""
