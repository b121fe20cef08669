"""What some apps have beside missions and drones, and the brain asks along with them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..alone.drones import IdealDrones
    from ..domain.app import App
    from ..domain.fields import FieldType
    from ..domain.model import Trip
    from ..domain.quantities import Type
    from ..domain.trace import Row
    from ..domain.values import Table


class PartOf:
    """What an app has beside missions and drones."""

    def drones(self) -> type[IdealDrones] | None:
        """Return the simulated drones that obey it, where others do not."""
        return None

    def movers(self, world: Table) -> tuple[Any, ...]:
        """Return what the `[world]` of a fleet file has for it."""
        return ()

    def happens(self, world: Table) -> tuple[Mapping[str, Any], ...]:
        """Return what happens in the simulated world, as its `[world]` says."""
        return ()

    def entries(self) -> tuple[str, ...]:
        """Return the blocks at which its missions enter the graph."""
        return ()

    def __call__(self, engine: Any) -> Any:
        """Return it in a running app: a `Part` of flow/mission.py."""
        raise NotImplementedError

    def about(self) -> dict[str, Any]:
        """Return it as plain data, for the library."""
        return {}

    def readers(self, app: App) -> Mapping[FieldType | Type, Callable[[Any], Any]]:
        """Return how fields of the types are read that only this part knows."""
        return {}

    def wrong(self, app: App, trip: Trip) -> str | None:
        """Return what is wrong with what a trip of a hook has for it."""
        return None

    def prepared(self, trip: Mapping[str, Any]) -> Mapping[str, Any]:
        """Return what trips have for what is written of one."""
        return trip


class Part:
    """What some apps have beside missions and drones, such as events; it may keep rows of its own."""

    commands: Mapping[str, Callable[[Mapping[str, Any]], None]] = MappingProxyType({})
    """What people can have it do, by the names of commands."""

    def tell(self, message: Mapping[str, Any]) -> None:
        """Take over what has happened outside, if that is for it."""

    def rows(self) -> list[Row]:
        """Return its rows that have changed since the last call."""
        return []

    def standing(self) -> Mapping[str, Any]:
        """Return all its rows, under the names of their tables."""
        return {}

    def restore(self, standing: Mapping[str, Any]) -> None:
        """Take over its rows of an earlier run."""

    def go_on(self) -> None:
        """Go on with what was not over at the end of an earlier run."""
