"""`simulate --runs N`: the same missions with many seeds, and what the runs have in common."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.alone.simulate import outcome_data
from plutoc_runtime.domain.text import (
    counted,
    duration,
    in_shell,
    number,
    percent,
    printable,
)
from plutoc_runtime.domain.trace import dumped

from ..trials.invariants import items_of
from .plot import drawing, kind_of, plot
from .report import last_line, table
from .summary import ENOUGH, Run, run_of, spread, summary
from .verdict import exit_code

if TYPE_CHECKING:
    from plutoc_runtime.alone.simulate import Outcome
    from plutoc_runtime.domain.app import App

    from .options import Options
    from .plans import Plan
    from .progress import Progress

BROKEN = 70
"""The exit code of a run that did what no run may do: that is a mistake of ours."""

_MOST_VIOLATIONS = 10


def often(app: App, options: Options, count: int, plan: Plan, progress: Progress, fly: Fly) -> int:
    """Fly with one seed after the other; say what came of each, and of all."""
    if options.plot is not None:
        kind_of(options.plot)
        drawing()  # whoever lacks it shall not fly first
    runs: list[Run] = []
    data: list[dict[str, object]] = []
    worst, items = 0, items_of(plan.missions)
    for place in range(count):
        seed = options.seed + place
        progress.update(place / count, f"run {place + 1} of {count}")
        outcome = fly(seed)
        run = run_of(seed, outcome, items)
        runs.append(run)
        worst = max(worst, BROKEN if run.violations else exit_code(outcome))
        if options.json:
            data.append(outcome_data(app.name, seed, outcome))
        else:
            progress.clear()
            why = f"; given up: {printable(outcome.given_up)}" if outcome.given_up else ""
            output.line(f"seed {seed}: {last_line(outcome)}{why}")
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


def _said(app: App, options: Options, runs: Sequence[Run]) -> Iterator[str]:
    yield ""
    yield from _figures(runs)
    yield ""
    broken = [run for run in runs if run.violations]
    if broken:
        yield from _broken(app, options, broken)
        yield ""
    yield _in_words(runs)


def _figures(runs: Sequence[Run]) -> Iterator[str]:
    """Yield a table of what the runs took; one run has no percentiles."""
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


def _broken(app: App, options: Options, runs: Sequence[Run]) -> Iterator[str]:
    """Yield what must never be, and how to see it again."""
    found = [(run.seed, sentence) for run in runs for sentence in run.violations]
    for seed, sentence in found[:_MOST_VIOLATIONS]:
        yield f"seed {seed} did what no run may do: {printable(sentence)}"
    if len(found) > _MOST_VIOLATIONS:
        yield f"and {len(found) - _MOST_VIOLATIONS} more"
    fleet = f" --fleet {in_shell(options.fleet)}" if options.fleet else ""
    shares = ",".join(f"{what}={share:.12g}" for what, share in options.fail.items())
    fail = f" --fail {shares}" if shares else ""
    until = f" --until {options.until:.12g}" if options.until else ""
    yield (
        f"See it again: {app.name} simulate {in_shell(options.missions)}{fleet} --seed {runs[0].seed}"
        f"{fail}{until} --trace trace.jsonl"
    )
    yield "This is a mistake of ours, or of whoever made a block: please report it, with that file."


def _in_words(runs: Sequence[Run]) -> str:
    good = [run.makespan for run in runs if run.success]
    text = (
        f"{len(good)} of {counted(len(runs), 'run')} succeeded ({percent(len(good) / len(runs))})"
    )
    if good:
        least, most = duration(min(good)), duration(max(good))
        who = "it" if len(good) == 1 else "each" if least == most else "they"
        text += f"; {who} took {least}" + (f" to {most}" if least != most else "")
    return text


Fly = Callable[[int], "Outcome"]
"""Flies the missions with a seed."""
