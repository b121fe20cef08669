"""`fly --dry-run`: every command that the drones would be given, and what would be refused.

The missions are flown as `simulate` flies them, in virtual time, by the very code that flies real
drones, and over simulated ones. No drone is reached, and nothing is written.
"""

from __future__ import annotations

from contextlib import suppress
from copy import deepcopy
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.alone.faults import Faults
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import counted, number
from plutoc_runtime.fleet.reach import CLIMB_SPEED

from ..drones.protocol import Acts
from ..drones.real_fleet import SLACK, real_fleet
from ..drones.vehicle import CLIMB_LIMIT
from ..flight.simulate import simulate
from .events import line_of
from .given import Given
from .plans import load
from .real import check_real, made
from .report import report, table
from .verdict import exit_code

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plutoc_runtime.alone.simulate import Outcome
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Point
    from plutoc_runtime.time.kernel import Kernel

    from ..drones.real_fleet import RequiredAction
    from ..files.drones import DroneEntry
    from ..jobs.controls import Controls
    from .given import Command
    from .options import Options
    from .plans import Plan

REFUSED = 2
"""The exit code where `fly` would not begin, or not fly some drone."""


def dry_run(app: App, options: Options) -> int:
    """Print what every drone would be told, and what came of it."""
    _refuse_what_does_not_go_together(options)
    plan = load(app, options)
    given: list[Given] = []
    top = {one.name: one.top_speed or one.speed for one in plan.app.categories}
    speeds = {drone.id: top[drone.category] for drone in plan.fleet.drones}
    climb = CLIMB_SPEED if options.sim else CLIMB_LIMIT

    def around(kernel: Kernel, drones: Controls) -> Given:
        given.append(Given(kernel, drones, speeds, climb))
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
        slack=0.0 if options.sim else SLACK,
    )
    for line in _lines(plan, outcome, given[0].commands):
        output.line(line)
    output.flush()
    refused = [] if options.sim else list(_refused(app, options, plan))
    for sentence in refused:
        output.tell(sentence)
    return REFUSED if refused else exit_code(outcome)


def _refused(app: App, options: Options, plan: Plan) -> Iterator[str]:
    """Yield what keeps `fly` from beginning, or a drone from being flown, as far as it is known."""
    try:
        where = str(options.fleet or app.name)
        check_real(app, plan.fleet, where, stand_ins=options.crtp_sim is not None)
    except BadInput as error:
        yield f"{app.name} fly would not begin:\n{error}"
        return
    if options.crtp_sim is not None:  # they are fitted with whatever the plan asks for
        return
    wanted = real_fleet(plan.fleet, plan.missions).wanted
    categories = {category.name: category for category in plan.app.categories}
    for drone in plan.fleet.drones:
        category = categories[drone.category]
        tasks = [one for one in wanted if category.can(one.action)]
        for reason in dict.fromkeys(_unfit(plan, drone, tasks)):
            yield f"{drone.id} would not be flown: {reason}"


def _unfit(plan: Plan, drone: DroneEntry, wanted: Sequence[RequiredAction]) -> Iterator[str]:
    """Yield what a drone's navigation says it cannot do, before there is any drone."""
    with TemporaryDirectory() as folder:
        navigation = made(plan.app, plan.fleet, drone, Path(folder))
        for one in wanted:
            if not isinstance(navigation, Acts):
                yield f"{drone.id} has no action {one.action}"
                continue
            with suppress(Exception):  # it is only asked to know this once it is connected
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


def _lines(plan: Plan, outcome: Outcome, commands: Sequence[Command]) -> Iterator[str]:
    yield from table(
        ("time", "drone", "command", "to", "at most"),
        [
            (
                f"{command.time:.1f} s",
                command.drone,
                command.what,
                "" if command.to is None else _place(command.to),
                "" if command.speed is None else f"{number(command.speed)} m/s",
            )
            for command in commands
        ],
        right=(0,),
    )
    yield ""
    failed = [event for event in outcome.events if event["event"] == "trip.failed"]
    if failed:
        yield "refused, or not done:"
        yield from filter(None, map(line_of, failed))
        yield ""
    yield from report(plan.app, outcome, plan.fleet.apart)
    yield f"{counted(len(commands), 'command')}; nothing has flown"


def _place(point: Point) -> str:
    return f"({', '.join(number(round(along, 2)) for along in point)})"
