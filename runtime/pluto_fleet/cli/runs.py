"""`simulate --runs N`: the same missions with many seeds, their statistics, and a plot."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from datetime import timedelta
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..process.text import in_shell
from ..process.workers import WorkerDied, cores, in_workers
from ..report.reactions import Reactions, reactions_of
from ..report.report import exit_code, last_line, simulation_data
from ..report.spread import spread
from ..report.terminal import table
from ..shared import output
from ..shared.alone.simulate import trips_data
from ..shared.domain.errors import BadInput
from ..shared.domain.status import COMPLETED
from ..shared.domain.text import counted, duration, number, percent, printable
from ..shared.domain.trace import dumped
from ..trials.invariants import Invariants, items_of
from ..trials.rules import ENDS
from .written import drawing, kind_of, write

if TYPE_CHECKING:
    from ..app import App
    from ..flight.outcome import SimulationResult
    from ..report.terminal import Progress
    from ..trials.drone_rules import Items
    from .options import Options
    from .plans import LoadedPlan

BROKEN = 70
"""The exit code of a run that violates an invariant, which is a bug of Pluto."""

_MOST_VIOLATIONS = _MOST_LATE = 10


class _Run(NamedTuple):
    """What a worker sends back of a run: what is said of it, and no more."""

    figures: RunFigures
    code: int
    text: str
    data: dict[str, object] | None
    """For `--json`."""


def often(
    app: App, options: Options, count: int, plan: LoadedPlan, progress: Progress, fly: Fly
) -> int:
    """Fly with many seeds on all cores; report each run, in the seeds' order, and all together."""
    if options.plot is not None:
        kind_of(options.plot)
        drawing()  # raises before anything flies
    items = items_of(plan.missions)

    def run(seed: int) -> _Run:
        outcome = fly(seed)
        figures = run_of(seed, outcome, items)
        code = BROKEN if figures.violations else exit_code(outcome)
        if options.json:
            return _Run(figures, code, "", simulation_data(app.name, seed, outcome))
        why = f"; given up: {printable(outcome.given_up)}" if outcome.given_up else ""
        return _Run(figures, code, f"seed {seed}: {last_line(outcome)}{why}", None)

    seeds = range(options.seed, options.seed + count)
    runs: list[RunFigures] = []
    data: list[dict[str, object]] = []
    worst = 0
    try:
        for done in in_workers(run, seeds, options.jobs or cores()):
            runs.append(done.figures)
            worst = max(worst, done.code)
            if done.data is not None:
                data.append(done.data)
            else:
                progress.clear()
                output.line(done.text)
            progress.update(len(runs) / count, f"{len(runs)} of {counted(count, 'run')}")
    except WorkerDied as end:
        raise died(app, seeds[end.place], end) from None
    progress.clear()
    if options.plot is not None:
        plot(options.plot, app.name, runs)
    if options.json:
        whole = {"app": app.name, "seed": options.seed, "runs": data, "summary": summary(runs)}
        output.line(dumped(whole))
    else:
        for line in _said(app, options, runs):
            output.line(line)
    return worst


def died(app: App, seed: int, end: WorkerDied) -> BadInput:
    """Return the error of a run whose process has ended before it."""
    return BadInput(
        f"{app.name}: the process that flew seed {seed} {end.how}: fewer of them need less memory"
        " (--jobs 1); if it is always this seed, something in hooks.py ends it"
    )


def _said(app: App, options: Options, runs: Sequence[RunFigures]) -> Iterator[str]:
    yield ""
    yield from _figures(runs)
    yield ""
    if reactions := [*_reactions(runs).lines()]:
        yield from reactions
        yield ""
    broken = [run for run in runs if run.violations]
    if broken:
        yield from _broken(app, options, broken)
        yield ""
    yield _in_words(runs)
    late = _late(runs)
    for name, count in [*late.items()][:_MOST_LATE]:
        share = percent(count / len(runs))
        yield f"late: {printable(name)} in {count} of {counted(len(runs), 'run')} ({share})"
    if len(late) > _MOST_LATE:
        yield f"and {counted(len(late) - _MOST_LATE, 'more mission')}"


def _late(runs: Sequence[RunFigures]) -> dict[str, int]:
    """Return in how many runs missions were late, the most often first."""
    return dict(Counter(name for run in runs for name in run.late).most_common())


def _reactions(runs: Sequence[RunFigures]) -> Reactions:
    """Return what came of the events of all runs."""
    whole = Reactions()
    for run in runs:
        whole.add(run.reactions)
    return whole


def _figures(runs: Sequence[RunFigures]) -> Iterator[str]:
    """Yield a table of statistics; a single run has no percentiles."""
    if len(runs) == 1:
        return
    lines = (
        ("completed missions", [float(run.completed) for run in runs], _whole),
        ("makespan", [run.makespan for run in runs if run.success], duration),
        ("flights", [float(run.attempts) for run in runs], _whole),
        ("failed flights", [float(run.failed) for run in runs], _whole),
        ("lowest battery", [run.battery for run in runs if run.battery is not None], percent),
    )
    rows = [
        (what, *(say(found[key]) for key in ("p5", "median", "p95")))
        for what, values, say in lines
        if (found := spread(values)) is not None
    ]
    yield from table(("", "p5", "median", "p95"), rows, right=(1, 2, 3))
    if len(runs) < ENOUGH:
        yield f"Of {counted(len(runs), 'run')}, p5 and p95 say little: fly {ENOUGH} or more."


def _whole(value: float) -> str:
    return number(round(value, 1))


def _broken(app: App, options: Options, runs: Sequence[RunFigures]) -> Iterator[str]:
    """Yield the violations, and how to reproduce them."""
    found = [(run.seed, sentence) for run in runs for sentence in run.violations]
    for seed, sentence in found[:_MOST_VIOLATIONS]:
        yield f"seed {seed} did what no run may do: {printable(sentence)}"
    if len(found) > _MOST_VIOLATIONS:
        yield f"and {len(found) - _MOST_VIOLATIONS} more"
    fleet = f" --fleet {in_shell(options.fleet)}" if options.fleet else ""
    shares = ",".join(f"{what}={share:.12g}" for what, share in options.fail.items())
    fail = f" --fail {shares}" if shares else ""
    until = f" --until {options.until:.12g}" if options.until else ""
    start = None if options.start is None else timedelta(seconds=options.start)
    begins = {"start": start, "date": options.date, "zone": options.zone}
    when = "".join(f" --{name} {value}" for name, value in begins.items() if value is not None)
    yield (
        f"See it again: {app.name} simulate {in_shell(options.missions)}{fleet} --seed {runs[0].seed}"
        f"{fail}{until}{when} --trace trace.jsonl"
    )
    yield "This is a mistake of ours, or of a block's author: please report it, with that file."


def _in_words(runs: Sequence[RunFigures]) -> str:
    good = [run.makespan for run in runs if run.success]
    text = (
        f"{len(good)} of {counted(len(runs), 'run')} succeeded ({percent(len(good) / len(runs))})"
    )
    if good:
        least, most = duration(min(good)), duration(max(good))
        who = "it" if len(good) == 1 else "each" if least == most else "they"
        text += f"; {who} took {least}" + (f" to {most}" if least != most else "")
    return text


Fly = Callable[[int], "SimulationResult"]
"""Flies the missions with a seed, in a worker."""


MOST_SEEDS = 20
ENOUGH = 20
"""The runs needed for percentiles: with fewer, the 5th and 95th are nearly the minimum and maximum."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunFigures:
    """The figures of one run for the summary."""

    seed: int
    success: bool
    makespan: float
    attempts: int
    failed: int
    """Flights that failed."""
    completed: int = 0
    """Missions that were completed."""
    battery: float | None = None
    """The lowest battery level at a landing; None: no drone flew."""
    late: tuple[str, ...] = ()
    """The missions that were late."""
    violations: tuple[str, ...] = ()
    """The invariants that this run violated."""
    reactions: Reactions = field(default_factory=Reactions)
    """What came of its events."""


def run_of(seed: int, outcome: SimulationResult, items: Items) -> RunFigures:
    """Return the figures of a run."""
    trips = trips_data(outcome)
    invariants = Invariants(items)
    levels: list[float] = []
    for event in outcome.events:
        invariants.take(event)
        level = event.get("battery")
        if isinstance(level, float):
            levels.append(level)
    whole = all(mission.status.value in ENDS for mission in outcome.missions)
    return RunFigures(
        seed=seed,
        success=exit_code(outcome) == 0,
        makespan=outcome.duration,
        attempts=trips["attempts"],
        failed=trips["failed"],
        completed=sum(mission.status is COMPLETED for mission in outcome.missions),
        battery=min(levels, default=None),
        late=tuple(mission.name for mission in outcome.missions if mission.late),
        violations=tuple(invariants.over() if whole else invariants.found),
        reactions=reactions_of(outcome.events),
    )


def summary(runs: Sequence[RunFigures]) -> dict[str, object]:
    """Return the figures of all runs; there is at least one.

    The makespan is that of the runs that succeeded: a mission that failed early is not a fast one.
    """
    good = [run for run in runs if run.success]
    bad = [run.seed for run in runs if not run.success]
    return {
        "runs": len(runs),
        "succeeded": len(good),
        "success_rate": len(good) / len(runs),
        "completed_missions": spread([float(run.completed) for run in runs]),
        "makespan_s": spread([run.makespan for run in good]),
        "attempts": spread([float(run.attempts) for run in runs]),
        "failed_trips": spread([float(run.failed) for run in runs]),
        "battery_level": spread([run.battery for run in runs if run.battery is not None]),
        **({"late": late} if (late := _late(runs)) else {}),
        **_reactions(runs).data(),
        "failed_seeds": bad[:MOST_SEEDS],
        "violations": [
            {"seed": run.seed, "what": sentence} for run in runs for sentence in run.violations
        ],
    }


def plot(path: Path, title: str, runs: Sequence[RunFigures]) -> None:
    """Write the plot: the same runs give the same bytes."""
    good = [run.makespan for run in runs if run.success]
    panels = (
        ("makespan of what succeeded, s", good),
        ("flights", [float(run.attempts) for run in runs]),
        ("lowest battery, %", [100 * run.battery for run in runs if run.battery is not None]),
    )
    rate = percent(len(good) / len(runs))
    title = f"{title}: {len(good)} of {len(runs)} succeeded ({rate})"
    write(path, drawing().histograms(kind_of(path), title, panels))
