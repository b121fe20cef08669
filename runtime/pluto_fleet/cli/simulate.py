"""`simulate`: the whole app in virtual time, and the file of `--trace`."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ..flight.outcome import SimulationResult
from ..flight.simulate import simulate as simulated
from ..journal.event_line import line
from ..process.signal_guard import Interrupted
from ..report.report import exit_code, report, simulation_data
from ..report.sentences import line_of
from ..report.terminal import Progress, simulation_progress
from ..shared import output
from ..shared.alone.world import Faults
from ..shared.domain.errors import BadInput
from ..shared.domain.text import duration
from ..shared.domain.trace import Event, dumped
from ..trials.case import fresh
from .plans import LoadedPlan, load
from .written import cannot, written

if TYPE_CHECKING:
    from ..app import App
    from .options import Options

Listener = Callable[[Event], None]


class Halt(Interrupted):
    """Stops a simulation from inside, so that an interrupt needs no cooperation of kernel or hooks."""

    def __init__(self, error: Exception) -> None:
        super().__init__()
        self.error = error


def simulate(app: App, options: Options) -> int:
    """Simulate the missions, once or with many seeds, and report the outcome."""
    plan = load(app, options)
    progress = simulation_progress(quiet=options.json or options.runs is not None)
    try:
        if options.runs is None:
            return _once(app, options, plan, progress)
        from .runs import often  # not needed for one run

        def again(seed: int) -> SimulationResult:
            return _fly(app, options, plan, seed, None)

        return often(app, options, options.runs, plan, progress, again)
    finally:
        progress.clear()


def _once(app: App, options: Options, plan: LoadedPlan, progress: Progress) -> int:
    watch = _watcher(options, len(plan.missions), progress)
    start = plan.hours.start
    if start and not options.json:
        output.line(f"starts at {start}")
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
            when = {"start": start} if start else {}
            output.line(dumped({**simulation_data(app.name, options.seed, outcome), **when}))
        else:
            output.line()
            for line in report(app, outcome, plan.fleet):
                output.line(line)
        output.flush()
    return exit_code(outcome)


def _fly(
    app: App, options: Options, plan: LoadedPlan, seed: int, listener: Listener | None
) -> SimulationResult:
    return simulated(
        app,
        [fresh(mission) for mission in plan.missions],  # a run changes its missions
        plan.fleet,
        seed=seed,
        faults=Faults(**options.fail),
        until=options.until,
        on_event=listener,
    )


def _watcher(options: Options, missions: int, progress: Progress) -> Listener:
    if not progress.is_told:
        return _forget
    ended = 0

    def watch(event: Event) -> None:
        nonlocal ended
        ended += event["event"] == "mission.ended"
        now = event["t"]
        gone = now / options.until if options.until else 0.0
        progress.update(max(gone, ended / missions), f"{duration(now)} simulated")

    return watch


def _tell(event: Event, progress: Progress) -> None:
    line = line_of(event)
    if line is not None:
        progress.clear()
        output.line(line)


@contextmanager
def trace_file(path: Path | None) -> Iterator[Callable[[Event], None]]:
    """Give a function that writes an event as a line; the file gets its name when it is complete."""
    if path is None:
        yield _forget
        return
    try:
        whole = Path(os.path.realpath(path))  # a link stays a link
        if path.is_dir():
            raise IsADirectoryError(0, "it is a folder")
        part = whole.with_name(f".{whole.name}.{os.getpid()}.part")
        # a pipe or a device cannot be replaced: it is written to directly
        replaced = path.is_file() or not path.exists()
        file = (part if replaced else path).open("w", encoding="utf-8")
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise cannot(path, "the trace", error) from None

    def finish() -> None:
        file.close()
        if replaced:
            part.replace(whole)

    try:
        yield lambda event: written(path, "the trace", lambda: file.write(line(event) + "\n"))
        written(path, "the trace", finish)
    finally:
        with suppress(OSError):
            file.close()
        if replaced:
            part.unlink(missing_ok=True)


def _forget(event: Event) -> None:
    pass
