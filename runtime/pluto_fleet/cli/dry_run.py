"""`fly --dry-run`: every command that the drones would be given, and why `fly` would refuse.

The missions are flown in virtual time with simulated drones, as by `simulate`, and by the very code
that flies real drones. They begin now, as by `fly`, or when it is said. No drone is reached, and nothing
is written.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from copy import deepcopy
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from ..drones.protocol import Acts
from ..drones.real_fleet import RequiredAction, real_fleet
from ..drones.vehicle import CLIMB_LIMIT
from ..files.toml import toml_value
from ..flight.simulate import simulate
from ..jobs.controls import (
    Act,
    ForwardingControls,
    GoTo,
    Hold,
    Land,
    Read,
    TakeOff,
    Trigger,
    Write,
)
from ..report.report import exit_code, report
from ..report.sentences import line_of
from ..report.terminal import table
from ..shared import output
from ..shared.alone.world import Faults
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted, number
from .plans import load, waiting
from .preflight import check_flight, made

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ..app import App
    from ..files.fleet import DroneEntry
    from ..flight.outcome import SimulationResult
    from ..jobs.controls import Command, Controls
    from ..shared.domain.model import Point
    from ..shared.time.kernel import Kernel
    from .options import Options
    from .plans import LoadedPlan


REFUSED = 2
"""The exit code if `fly` would refuse to begin, or to fly some drone."""


def dry_run(app: App, options: Options) -> int:
    """Print the commands that each drone would be given, and the outcome."""
    _refuse_what_does_not_go_together(options)
    plan = load(app, options)
    given: list[CommandLog] = []
    top = {one.name: one.speed for one in plan.app.categories}
    speeds = {drone.id: top[drone.category] for drone in plan.fleet.drones}
    motion = plan.fleet.motion
    climb = CLIMB_LIMIT if motion.smooth else max(motion.up, motion.down)

    def around(kernel: Kernel, drones: Controls) -> CommandLog:
        given.append(CommandLog(kernel, drones, speeds, climb))
        return given[0]

    outcome = simulate(
        plan.app,
        deepcopy(plan.missions),
        plan.fleet,
        seed=options.seed,
        faults=Faults(**options.fail),
        until=options.until,
        on_event=None,
        around=around,
    )
    for line in _lines(plan, outcome, given[0].rows, options.says_when):
        output.line(line)
    output.flush()
    refused = [] if options.sim else list(_refused(app, options, plan))
    for sentence in refused:
        output.tell(sentence)
    return REFUSED if refused else exit_code(outcome)


def _refused(app: App, options: Options, plan: LoadedPlan) -> Iterator[str]:
    """Yield the known reasons why `fly` would not begin, or not fly some drone."""
    try:
        check_flight(app, plan.fleet, options)
    except BadInput as error:
        yield f"{app.name} fly would not begin:\n{error}"
        return
    if options.stand_ins is not None:  # they have all the equipment that the plan needs
        return
    wanted = real_fleet(plan.fleet, plan.missions).wanted
    categories = {category.name: category for category in plan.app.categories}
    for drone in plan.fleet.drones:
        category = categories[drone.category]
        tasks = [one for one in wanted if category.can(one.action)]
        for reason in dict.fromkeys(_unfit(plan, drone, tasks)):
            yield f"{drone.id} would not be flown: {reason}"


def _unfit(plan: LoadedPlan, drone: DroneEntry, wanted: Sequence[RequiredAction]) -> Iterator[str]:
    """Yield what a drone's navigation says that it cannot do, before it is connected."""
    with TemporaryDirectory() as folder:
        navigation = made(plan.app, plan.fleet, drone, Path(folder))
        for one in wanted:
            if not isinstance(navigation, Acts):
                yield f"{drone.id} has no action {one.action}"
                continue
            with suppress(Exception):  # it need not know this before it is connected
                why = navigation.why_not(one.action, one.parameters)
                if why is not None:
                    yield str(why)


def _refuse_what_does_not_go_together(options: Options) -> None:
    options.refuse_what_is_simulated()
    given = {
        "--journal": options.journal,
        "--supervise": options.supervise,
        "--speed": options.speed,
    }
    for flag, value in given.items():
        if value:
            raise BadInput(f"{flag} is for a flight, and --dry-run is none: leave one out")


def _lines(
    plan: LoadedPlan, outcome: SimulationResult, commands: Sequence[Sequence[str]], starts: bool
) -> Iterator[str]:
    if starts:
        yield f"starts at {plan.hours.start}"
    yield from waiting(plan)
    yield from table(("time", "drone", "command", "to", "at most"), commands, right=(0,))
    yield ""
    failed = [event for event in outcome.events if event["event"] == "trip.failed"]
    if failed:
        yield "refused, or not done:"
        yield from filter(None, map(line_of, failed))
        yield ""
    yield from report(plan.app, outcome, plan.fleet)
    yield f"{counted(len(commands), 'command')}; nothing has flown"


def _place(point: Point) -> str:
    return f"({', '.join(number(round(along, 2)) for along in point)})"


class CommandLog(ForwardingControls):
    """Controls that log each command and forward it to the simulated drones."""

    def __init__(
        self, kernel: Kernel, drones: Controls, speeds: Mapping[str, float], climb: float
    ) -> None:
        super().__init__(drones)
        self.break_off = self._break_off
        self.turn = self._turn
        self._kernel = kernel
        self._speeds, self._climb_limit = speeds, climb
        self.rows: list[tuple[str, str, str, str, str]] = []

    def _note(
        self, drone: str, what: str, to: Point | None = None, speed: float | None = None
    ) -> None:
        where = "" if to is None else _place(to)
        how_fast = "" if speed is None else f"{number(speed)} m/s"
        self.rows.append((f"{self._kernel.now:.1f} s", drone, what, where, how_fast))

    def _here(self, drone: str, height: float) -> Point:
        x, y, _ = self._controls.telemetry[drone].location
        return x, y, height

    def _climb(self, drone: str) -> float:
        return min(self._climb_limit, self._speeds[drone])

    def _turn(self, drone: str, command: GoTo) -> bool:
        turned = self._controls.turn(drone, command)
        if turned:
            self._note(drone, "go on to", command.target, self._speeds[drone])
        return turned

    async def do(self, drone: str, command: Command) -> Any:
        """Note a command, and carry it out."""
        landed = self.telemetry[drone].landed
        match command:
            case TakeOff(height) if landed:
                self._note(drone, "take off", self._here(drone, height), self._climb(drone))
            case GoTo(target, _):
                self._note(drone, "go to", target, self._speeds[drone])
            case Land() if not landed:
                self._note(drone, "land", self._here(drone, 0.0), self._climb(drone))
            case Hold():
                self._note(drone, "hover, for an action of the app's own")
            case Act(action, parameters, item):
                given = [f"{name} = {toml_value(one)}" for name, one in parameters.items()]
                what = [*([] if item is None else [toml_value(item.name)]), *given]
                self._note(drone, f"{action}, {', '.join(what)}" if what else action)
            case Trigger(action):
                self._note(drone, f"{action} on the way", self.telemetry[drone].location)
            case Read(name):
                self._note(drone, f"read {name}")
            case Write(name, value):
                self._note(drone, f"set {name} = {value!r}")
            case _:
                pass
        return await self._controls.do(drone, command)

    def _break_off(self, drone: str) -> None:
        if not self.telemetry[drone].landed:
            self._note(drone, "stop, and hover")
        self._controls.break_off(drone)
