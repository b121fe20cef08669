"""Who tells drones where they are: they themselves, or somebody who sees them from outside.

A drone that estimates its own position (by a Lighthouse deck, Loco anchors, a flow deck, GPS) needs
nothing of this: that is the localization `own`. Any other is a class of a user's, named in the fleet
file; what it says is fed to the drones by `feeding.py`, beside their flights.
"""

from __future__ import annotations

from collections.abc import AsyncIterator
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

OWN = "own"
"""The name of the localization that feeds nothing."""


class Localization(Protocol):
    """Somebody who sees the drones; the class is called with the table `[localization]`."""

    def positions(self) -> AsyncIterator[tuple[str, Point]]:
        """Return who is where, for as long as anybody iterates: the drone's id, and its position.

        Metres, in the map's frame: who measures in another one converts here. At least ten times a
        second for each drone; one that has had none for a second may not take off, and its flight
        fails. A drone that cannot be seen is left out, never given its last place again.

        Most simply an async generator: what it has opened it closes in its `finally`. If it ends or
        raises, it is called again a second later. Nothing in it may hold up the event loop.
        """
        ...
