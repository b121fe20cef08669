"""Driving a brain on a kernel, virtual or real: its orders go to a gateway, and what comes of them back."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ..shared.hooks.plain_data import mission_data
from ..shared.time.kernel import FLEET, EventKind, Future

if TYPE_CHECKING:
    from ..app import App
    from ..jobs.link import Message, Order
    from ..shared.brain import Brain
    from ..shared.domain.model import Mission, Point
    from ..shared.domain.trace import Event
    from ..shared.time.kernel import Kernel, Timer


def begun(app: App, missions: Iterable[Mission[Any]]) -> list[dict[str, Any]]:
    """Return missions as a brain takes them to begin."""
    return [{"name": one.name, **mission_data(app, one)} for one in missions]


Stands = Mapping[str, tuple["Point", float]]
"""Where each drone stands on the ground, and the charge of its battery, from 0 to 1."""


def take_up(brain: Brain, drones: Iterable[str], now: float) -> None:
    """Have a new brain look at its drones as at the start of a flight: low ones charge, or fly home."""
    brain.go_on({}, {drone: {} for drone in drones}, now)


class Driver:
    """Calls a brain when something has happened or is due, and passes on what it says."""

    def __init__(
        self,
        kernel: Kernel,
        brain: Brain,
        *,
        obey: Callable[[Order], object],
        motions: Callable[[], Mapping[str, Any]],
        hear: Callable[[Event], object],
    ) -> None:
        """`motions` returns the telemetry of the drones that have changed since its last call."""
        self._kernel, self._brain = kernel, brain
        self._obey, self._motions, self._hear = obey, motions, hear
        self._told: deque[Message] = deque()
        self._busy = False
        self._next: Timer | None = None
        """The next call of the brain, and the only one that is scheduled."""
        self._next_at: float | None = None
        self.halted = False
        """Whether the brain is not called any more."""
        self.drift: Callable[[], float | None] = _no_drift
        """Returns how far the clock of the hours has drifted; None: as far as before."""
        self.pumped: Callable[[], object] = _nothing
        """Called when the brain has been told, and has said, all that there was."""
        self.done: Future[float] = Future()
        """Set to the time at which the last mission ended, once every drone has landed as well."""

    def tell(self, message: Message) -> None:
        """Tell the brain something, now or as soon as it has done what it is doing."""
        self._told.append(message)
        self.pump()

    def call(self, call: Callable[[float], object]) -> None:
        """Call the brain with the time, and pass on what it says."""
        if not self.halted:
            self.look()
            call(self._kernel.now)
            self.pump()

    def halt(self) -> None:
        """Call the brain no more, and obey it no more."""
        self.halted = True

    def pump(self) -> None:
        """Pass on what the brain says, and tell it what there is to tell, until there is nothing more."""
        if self._busy or self.halted:
            return
        brain, told = self._brain, self._told
        self._busy = True
        try:
            while True:
                for event in brain.events():
                    self._hear(event)
                for order in brain.orders():
                    self._obey(order)
                if not told or self.halted:
                    break
                message = told.popleft()
                if motions := self._motions():
                    message["telemetry"] = motions
                brain.tell(message, self._kernel.now)
        finally:
            self._busy = False
        if self.halted:
            return
        self.pumped()
        over, due = brain.over, brain.due
        if over is not None:
            self.done.set(over)
        if due != self._next_at:
            if self._next is not None:
                self._next.cancel()
            self._next, self._next_at = None, due
            if due is not None:
                # after all else of that instant: it is all that is known then
                self._next = self._kernel.at(due, EventKind.ALLOCATE, FLEET, self._advance)

    def _advance(self) -> None:
        self._next = self._next_at = None
        if not self.halted:
            self.look()
            self.ask_for_the_hour()
            self._brain.advance(self._kernel.now)
            self.pump()

    def ask_for_the_hour(self) -> None:
        """Tell the brain if the clock of the hours has moved."""
        drift = self.drift()
        if drift is not None:
            self.tell({"drift": drift})

    def look(self) -> None:
        """Tell the brain where the drones are: hooks may look between two of its calls."""
        if not self.halted and (motions := self._motions()):
            self._brain.tell({"telemetry": motions}, self._kernel.now)


def _no_drift() -> None:
    """Say that the clock has not moved."""


def _nothing() -> None:
    """Do nothing: no callback is set."""
