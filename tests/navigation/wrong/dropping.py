"""Lets go of its drone by switching it off, as its library does."""

from __future__ import annotations

from tests.navigation.simulated import Simulated

FOUND_BY = "test_closing_in_the_air_never_cuts_the_motors"
SAYS = "close cut the motors"


class Wrong(Simulated):
    """It falls."""

    async def close(self) -> None:
        if self.telemetry.flying:
            await self.obey(self.team.cut(self.id))
        await super().close()
