"""`fly`: the whole app in real time."""

from __future__ import annotations

import asyncio
import signal
from contextlib import suppress
from typing import TYPE_CHECKING

from ..errors import BadInput
from ..fly import fly_simulated
from ..simulation.faults import Faults
from . import output
from .events import line_of
from .plans import Plan, load
from .report import report
from .verdict import exit_code

if TYPE_CHECKING:
    from ..app import App
    from ..session import Outcome
    from ..trace import Event
    from .options import Options

TERMINATED = 143


def fly(app: App, options: Options) -> int:
    """Fly the missions and say what came of them; whoever interrupts it lands the drones."""
    if not options.sim:
        raise BadInput(f"{app.name}: real drones are not supported yet: use --sim")
    plan = load(app, options)
    try:
        outcome = asyncio.run(flown(app, plan))
    except asyncio.CancelledError:
        return TERMINATED  # Ctrl-C comes out as KeyboardInterrupt instead
    output.line()
    for line in report(app, outcome):
        output.line(line)
    return exit_code(outcome)


async def flown(app: App, plan: Plan) -> Outcome:
    """Fly a plan; whoever cancels this waits until all drones have landed."""
    _terminate_gently()
    flight = asyncio.ensure_future(
        fly_simulated(app, plan.missions, plan.fleet, seed=0, faults=Faults(), on_event=_tell)
    )
    try:
        return await asyncio.shield(flight)
    except asyncio.CancelledError:
        output.tell("stopping: the drones land where they are (once more to leave at once)")
        flight.cancel()
        with suppress(asyncio.CancelledError):
            await flight
        output.tell("all drones have landed")
        raise


def _terminate_gently() -> None:
    """Let whoever stops the service, not only Ctrl-C, land the drones first."""
    task = asyncio.current_task()
    with suppress(NotImplementedError, RuntimeError, ValueError):  # Windows; not the main thread
        if task is not None:
            asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, task.cancel)


def _tell(event: Event) -> None:
    line = line_of(event)
    if line is not None:
        with suppress(output.ClosedPipe, output.CannotWrite):  # whoever watches has gone: fly on
            output.line(line)
            output.flush()
