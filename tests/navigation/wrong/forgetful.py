"""Lets go of everything when it is connected a second time, as after a lost link."""

from __future__ import annotations

from tests.navigation.simulated import Simulated

FOUND_BY = "test_it_connects_again_and_goes_on_telling"
SAYS = "it tells nothing any more"


class Wrong(Simulated):
    """It hears what its first link told, for ever."""

    linked = 0

    async def connect(self) -> None:
        self.linked += 1
        await super().connect()
        self.muted = self.linked > 1
