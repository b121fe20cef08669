"""The world of a trial: drones, gateway and clock, which outlive every brain."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

from ..gateway.gateway import Gateway
from ..gateway.ledger import Ledger
from ..jobs.controls import fleet_drones
from ..shared.alone.world import Faults, World
from ..shared.time.kernel import FLEET
from ..shared.time.kernel import EventKind as When
from ..shared.time.told import VirtualTime
from ..simulation.drones import SimulatedNavigation, WorldAction
from ..simulation.radio import Radio
from .case import Strike
from .record import TrialRecord

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..app import App
    from ..jobs.controls import Controls
    from .case import Case


class TrialWorld:
    """Everything of a trial except its brains."""

    def __init__(self, app: App, case: Case) -> None:
        self.app, self.case = app, case
        self.record = TrialRecord(app, case)
        self.fired, self.found = self.record.fired, self.record.found
        self.chance = Random(f"{case.seed}/trial")
        self.world = world = VirtualTime()
        self.drones = fleet_drones(app, case.fleet)
        airspace = case.fleet.airspace
        self.navigation = SimulatedNavigation(
            world,
            self.drones,
            World(case.seed, airspace, case.fleet.world),
            Faults(
                crash=case.weather.crash,
                link=case.weather.link,
                action=case.weather.action,
                battery=case.weather.battery,
            ),
            case.seed,
            self.seen,
        )
        self.ledger = Ledger()
        self.loses_report = False
        """Whether the next report is lost, and the connection with it."""
        self.gateway = self.new_gateway()
        self.lives = 0
        self.skew = 0.0
        """How many seconds the brain's clock is ahead of the world's."""
        self.strikes: dict[int, list[Strike]] = {}
        """The strikes by row."""
        for strike in case.strikes:
            self.strikes.setdefault(strike.row, []).append(strike)
        self.over = False

    def blame(self, error: BaseException) -> None:
        """Report an uncaught error as a finding."""
        where = "".join(f", {note}" for note in getattr(error, "__notes__", ()))
        what = f"the app ended with an internal error: {type(error).__name__}: {error}{where}"
        self.found.append(f"{self.world.now:g} s: {what}")
        self.over = True

    def raise_from(self, kernel: VirtualTime) -> None:
        """End the trial with an uncaught error, which is a bug of Pluto."""
        if kernel.crashed is not None:
            error, kernel.crashed = kernel.crashed, None
            self.blame(error)

    def later(self, seconds: float, call: Callable[[], object]) -> None:
        """Schedule a call after seconds of the world's time."""
        self.world.at(self.world.now + seconds, When.FLIGHT, FLEET, call)

    def seen(self, done: WorldAction) -> None:
        """Called with an action of a drone on the world."""
        if done.job is not None:
            self.record.did(done.job, done.action, self.world.now)

    def new_gateway(self) -> Gateway:
        """Return a new gateway over the same drones and ledger."""
        fleet, radio = self.case.fleet, self.case.weather.radio
        controls: Controls = self.navigation
        if radio:
            controls = Radio(self.world, self.navigation, self.radio_delay)
        return Gateway(
            self.world,
            controls,
            self.drones,
            fleet.airspace,
            ledger=self.ledger,
            apart=fleet.apart,
            max_airborne=fleet.max_airborne,
        )

    def radio_delay(self, _: str) -> float:
        """Return the delay of a message to or from a drone."""
        self.fired["slow radio"] += 1
        return self.case.weather.radio

    def report_is_lost(self) -> bool:
        """Return whether a report is lost, and the connection with it."""
        lost, self.loses_report = self.loses_report, False
        return lost
