"""`simulate`: the whole app in virtual time."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.alone.faults import Faults
from plutoc_runtime.alone.simulate import Outcome, outcome_data
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import duration
from plutoc_runtime.domain.trace import Event, dumped

from ..flight.simulate import simulate as simulated
from ..process.signal_guard import Interrupted
from .events import line_of
from .plans import Plan, load
from .progress import Progress, on_terminal
from .report import report
from .trace_file import trace_file
from .verdict import exit_code

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from .options import Options

Listener = Callable[[Event], None]


class Halt(Interrupted):
    """Stops a simulation from inside: neither the kernel nor a hook stands in an interrupt's way."""

    def __init__(self, error: Exception) -> None:
        super().__init__()
        self.error = error


def simulate(app: App, options: Options) -> int:
    """Simulate the missions, once or with many seeds, and say what came of them."""
    plan = load(app, options)
    progress = on_terminal(quiet=options.json or options.runs is not None)
    try:
        if options.runs is None:
            return _once(app, options, plan, progress)
        from .often import often  # one run has no need of it

        def again(seed: int) -> Outcome:
            return _fly(app, options, plan, seed, None)

        return often(app, options, options.runs, plan, progress, again)
    finally:
        progress.clear()


def _once(app: App, options: Options, plan: Plan, progress: Progress) -> int:
    watch = _watcher(options, len(plan.missions), progress)
    with trace_file(options.trace) as write:

        def listen(event: Event) -> None:
            try:
                write(event)
                if not options.json:
                    _tell(event, progress)
            except (BadInput, output.ClosedPipe, output.CannotWrite) as error:
                raise Halt(error) from None
            watch(event)

        try:
            outcome = _fly(app, options, plan, options.seed, listen)
        except Halt as halt:
            raise halt.error from None
        progress.clear()
        if options.json:
            output.line(dumped(outcome_data(app.name, options.seed, outcome)))
        else:
            output.line()
            for line in report(app, outcome, plan.fleet.apart):
                output.line(line)
        output.flush()
    return exit_code(outcome)


def _fly(app: App, options: Options, plan: Plan, seed: int, listener: Listener | None) -> Outcome:
    return simulated(
        app,
        deepcopy(plan.missions),  # a run changes its missions
        plan.fleet,
        seed=seed,
        faults=Faults(**options.fail),
        until=options.until,
        on_event=listener,
    )


def _watcher(options: Options, missions: int, progress: Progress) -> Listener:
    ended = 0

    def watch(event: Event) -> None:
        nonlocal ended
        ended += event["event"] == "mission.ended"
        now = float(str(event["t"]))
        gone = now / options.until if options.until else 0.0
        progress.update(max(gone, ended / missions), f"{duration(now)} simulated")

    return watch


def _tell(event: Event, progress: Progress) -> None:
    line = line_of(event)
    if line is not None:
        progress.clear()
        output.line(line)
