"""`simulate`: the whole app in virtual time."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from typing import TYPE_CHECKING

from ..errors import BadInput
from ..session import Outcome
from ..session import simulate as simulated
from ..simulation.faults import Faults
from ..trace import Event
from ..words import counted, duration, percent
from . import output
from .as_json import dumped, outcome_data, trips_data
from .events import line_of
from .plans import Plan, load
from .progress import Progress, on_terminal
from .report import last_line, report
from .summary import Run, summary
from .trace_file import trace_file
from .verdict import exit_code

if TYPE_CHECKING:
    from ..app import App
    from .options import Options

Listener = Callable[[Event], None]


class Halt(KeyboardInterrupt):
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
        return _often(app, options, options.runs, plan, progress)
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
            for line in report(app, outcome):
                output.line(line)
        output.flush()
    return exit_code(outcome)


def _often(app: App, options: Options, count: int, plan: Plan, progress: Progress) -> int:
    runs: list[Run] = []
    data: list[dict[str, object]] = []
    worst = 0
    for number in range(count):
        seed = options.seed + number
        progress.update(number / count, f"run {number + 1} of {count}")
        outcome = _fly(app, options, plan, seed, None)
        runs.append(_run(seed, outcome))
        worst = max(worst, exit_code(outcome))
        if options.json:
            data.append(outcome_data(app.name, seed, outcome))
        else:
            progress.clear()
            output.line(f"seed {seed}: {last_line(outcome)}")
    figures = summary(runs)
    if options.json:
        whole = {"app": app.name, "seed": options.seed, "runs": data, "summary": figures}
        progress.clear()
        output.line(dumped(whole))
    else:
        output.line()
        output.line(_in_words(runs))
    return worst


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


def _run(seed: int, outcome: Outcome) -> Run:
    trips = trips_data(outcome)
    return Run(
        seed=seed,
        success=exit_code(outcome) == 0,
        makespan=outcome.duration,
        attempts=trips["attempts"],
        failed=trips["failed"],
    )


def _in_words(runs: list[Run]) -> str:
    good = [run.makespan for run in runs if run.success]
    text = (
        f"{len(good)} of {counted(len(runs), 'run')} succeeded ({percent(len(good) / len(runs))})"
    )
    if good:
        least, most = duration(min(good)), duration(max(good))
        who = "it" if len(good) == 1 else "each" if least == most else "they"
        text += f"; {who} took {least}" + (f" to {most}" if least != most else "")
    return text
