"""`size`: how many drones the missions need, to be completed by a time with a confidence."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..files.writing import fleet_text
from ..process.workers import WorkerDied, cores
from ..report.terminal import Progress, simulation_progress
from ..shared import output
from ..shared.alone.world import Faults
from ..shared.domain.errors import BadInput
from ..shared.domain.fields import Entity, FieldType
from ..shared.domain.text import counted, duration
from ..shared.domain.trace import dumped
from ..shared.flow.promises import kept_from
from ..sizing.answer import Answer, sized
from ..sizing.fleets import Stock
from ..sizing.question import Question, swapping
from ..sizing.report import data, report
from ..sizing.tries import Rule, usual_runs
from .plans import load
from .written import drawing, kind_of, refuse_if_there, write, write_new

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..app import App
    from ..shared.domain.model import Mission
    from ..shared.time.hours import Hours
    from ..sizing.tries import Tally
    from .options import Options
    from .plans import LoadedPlan

FOR_A_MISSION, AND_MORE = 4, 4
"""Drones for each mission, and some more, that are tried by default: one flies, the others charge."""


def size(app: App, options: Options) -> int:
    """Find the smallest fleet and report it; the exit code is 1 if there is none."""
    if options.plot is not None:
        kind_of(options.plot)
        drawing()  # raises before anything flies
    refuse_if_there(options.write)
    plan = load(app, options)
    given = len(plan.fleet.drones)
    stock = Stock(
        fleet=plan.fleet,
        missions=plan.missions,
        most=options.most or max(given, FOR_A_MISSION * len(plan.missions) + AND_MORE),
    )
    runs = options.runs or usual_runs(options.confidence)
    rule = Rule(confidence=options.confidence, runs=runs)
    progress = simulation_progress(quiet=True)
    try:
        answer = sized(
            _question(plan, options),
            stock,
            rule,
            seed=options.seed,
            jobs=options.jobs or cores(),
            watch=lambda tally: _show(progress, tally, rule),
        )
    except WorkerDied as end:
        raise BadInput(
            f"{app.name}: a process that flew the missions {end.how}: fewer of them need less memory"
            " (--jobs 1)"
        ) from None
    finally:
        progress.clear()
    _tell(answer, app, options, plan.hours.start)
    return 0 if answer.found is not None else 1


def _question(plan: LoadedPlan, options: Options) -> Question:
    app, by = plan.app, options.by
    begin = _begin(plan)
    if by is not None and by.is_time_of_day and begin is None and options.start is None:
        raise BadInput(
            f"{options.missions}: --by {by.text} is a time of day, and not all missions begin at one"
            ' (at = "08:00", or a window): say when they are started, such as --start 08:00, or how'
            ' long they may take, such as --by "20 min"'
        )
    begin = begin or 0.0
    ends = None
    if by is not None:
        ends = plan.hours.next(by.seconds, begin) if by.is_time_of_day else begin + by.seconds
    question = Question(
        app=app, missions=plan.missions, faults=Faults(**options.fail), begin=begin, by=ends
    )
    if options.swap is None:
        return question
    return replace(question, app=swapping(app, options.swap), swapped=app)


def _begin(plan: LoadedPlan) -> float | None:
    """Return when the first mission begins, after the start; None: not all begin at an hour."""
    names = [
        one.name
        for one in plan.app.fields
        if one.on is Entity.MISSION and one.type is FieldType.TIME_OF_DAY
    ]
    moments = [_begins(one, names, plan.hours) for one in plan.missions]
    known = [one for one in moments if one is not None]
    return min(known) if known and len(known) == len(moments) else None


def _begins(mission: Mission[Any], names: Sequence[str], hours: Hours) -> float | None:
    """Return when a mission begins by its window, and by its fields with an hour, if it has any."""
    promises = kept_from(mission.promises, hours)
    by_hour = "opens" in promises.get("hours", ())
    opens = max(promises["opens"], 0.0) if by_hour else None
    given = [at for name in names if (at := getattr(mission, name)) is not None]
    return max((hours.next(at, opens or 0.0) for at in given), default=opens)


def _show(progress: Progress, tally: Tally, rule: Rule) -> None:
    runs = len(tally.runs)
    text = (
        f"{counted(tally.drones, 'drone')}: {tally.succeeded} of {counted(runs, 'run')} succeeded"
    )
    progress.update(runs / rule.runs, text)


def _tell(answer: Answer, app: App, options: Options, start: str) -> None:
    if options.plot is not None:
        _plot(options.plot, app.name, answer)
    if options.write is not None and answer.found is not None:
        fleet = answer.stock.of(answer.found.counts)
        assert fleet is not None
        write_new(options.write, fleet_text(fleet), "the fleet")
    if options.json:
        when = {"start": start} if start else {}
        output.line(dumped({**data(answer, app.name, options.seed), **when}))
        return
    if start:
        output.line(f"starts at {start}")
    for line in report(answer):
        output.line(line)


def _plot(path: Path, name: str, answer: Answer) -> None:
    """Draw the probability of success over the number of drones: the best fleet of each size."""
    best: dict[int, Tally] = {}
    for tally in answer.tallies:
        known = best.get(tally.drones)
        if known is None or tally.bounds > known.bounds:
            best[tally.drones] = tally
    points = [
        (drones, tally.succeeded / len(tally.runs), *tally.bounds)
        for drones, tally in sorted(best.items())
    ]
    within = answer.question.within
    title = f"{name}: success" + ("" if within is None else f" within {duration(within)}")
    picture = drawing().sizes(kind_of(path), title, points, answer.rule.confidence)
    write(path, picture)
