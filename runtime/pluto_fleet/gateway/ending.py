"""When the gateway's process is not needed any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plutoc_runtime.time.kernel import FLEET, Kind

from ..jobs.reports import Down

if TYPE_CHECKING:
    from plutoc_runtime.time.future import Future

    from .gateway import Gateway
    from .server import Server
    from .settings import Settings

LINGERS = 120.0
"""Seconds for which one that may hover, unheard, is waited for when nobody needs the gateway else."""


class Ending:
    """Sees to it that the process ends, and only when all drones are down.

    A real drone that does not answer may still be in the air: it lands if it is back in time. No
    brain is kept waiting for that.
    """

    def __init__(self, gateway: Gateway, over: Future[None], settings: Settings) -> None:
        self._gateway, self._over = gateway, over
        self._second = settings.speed
        self._idle, self._patience = settings.idle, settings.patience
        self.server: Server | None = None
        self._alone = -1.0
        """Seconds without a brain and without a drone in the air."""
        self._told: float | None = None
        """Seconds since somebody wants it to end."""
        self._lingers = 0.0 if settings.real is None else LINGERS
        self._left: float | None = None
        """Seconds that are left to a drone that may hover."""

    def goodbye(self) -> None:
        """End, once all drones are down."""
        gateway = self._gateway
        if gateway.flies:
            gateway.fail_safe(Down.LAND).watch(lambda _: self._down())
        else:
            self._over.set(None)

    def _down(self) -> None:
        """All that can be told are down: end, or wait for who cannot, but keep no brain waiting."""
        if not self._gateway.flies or self._lingers <= 0.0:
            self._over.set(None)
        elif self._left is None:
            self._left = self._lingers
            if self.server is not None:
                self.server.hang_up()

    def _linger(self, brain: bool) -> None:
        """Wait a second more for a drone that may hover: without a brain it is landed when heard."""
        if brain:
            self._left = None
        elif self._left is not None:
            self._left -= 1.0
            gateway = self._gateway
            if self._left <= 0.0 or not (gateway.flies or gateway.descent is not None):
                self._over.set(None)

    def told_to_end(self) -> None:
        """End as if told goodbye, but give a brain that was told the same the time to stop."""
        if self._told is None:
            self._told = 0.0

    def look(self) -> None:
        """End when nobody has come for a while; look again a second later."""
        gateway, kernel = self._gateway, self._gateway.kernel
        brain = self.server is not None and self.server.has_a_brain
        busy = brain or gateway.flies or gateway.descent is not None
        self._alone = -1.0 if busy else self._alone + 1.0
        self._linger(brain)
        if self._told is not None:
            self._told += 1.0
            if self._told > self._patience and gateway.descent is None and self._left is None:
                self.goodbye()
        if self._alone > (self._idle if self._told is None else 0.0):
            self._over.set(None)
        kernel.schedule(kernel.now + self._second, Kind.CLOCK, FLEET, self.look)
