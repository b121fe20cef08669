"""Lands by switching its motors off where it is."""

from __future__ import annotations

from tests.navigation.simulated import Simulated

FOUND_BY = "test_nothing_but_emergency_stop_cuts_the_motors"
SAYS = "its motors were off in the air"


class Wrong(Simulated):
    """It is down at once."""

    async def land(self, speed: float) -> None:
        await self.obey(self.team.cut(self.id))
