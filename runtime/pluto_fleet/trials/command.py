"""`plutoc test`, within the app that was compiled for it."""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Callable, Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from math import inf
from operator import attrgetter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ..app import App
from ..arguments import whole_number
from ..files.fleet import DroneEntry, FleetFile, default_fleet, load_fleet
from ..files.missions import load_missions
from ..files.plan_check import problems
from ..files.writing import fleet_text, missions_text
from ..process.text import in_shell
from ..report.sentences import line_of
from ..report.terminal import table, trial_progress
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.fields import Entity, FieldType
from ..shared.domain.model import Mission
from ..shared.domain.quantities import typed
from ..shared.domain.text import counted, printable
from ..shared.domain.trace import dumped
from ..shared.fleet.reach import idle_actions
from .case import (
    ENDS,
    FAIR,
    WORDS,
    WRITTEN,
    Case,
    Strike,
    Weather,
    strikes_of,
    strikes_text,
    weather_of,
    weather_text,
)
from .explore import (
    Finding,
    MistakeKinds,
    Tally,
    everywhere,
    explored,
    first_the_same,
    random_case,
    shows_the_same,
    shrunk,
    small_case,
)
from .lives import tried
from .record import TrialResult

FOUND, BAD_INPUT = 1, 2

STRUCK_EVERYWHERE = 3
"""The number of seeds for which every strike is tried at every row."""
MOST_FINDINGS = 5
"""The number of findings after which the search ends."""

_WRONG = attrgetter("wrong")


ByItself = Callable[[list[str]], int]
"""Runs the program with these arguments in a new process, and returns the exit code."""


def test(app: App, argv: Sequence[str], by_itself: ByItself | None = None) -> int:
    """Try the app, report the findings, and return the exit code."""
    try:
        options = parse(argv)
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else BAD_INPUT
    return _tried(app, options, by_itself)


def _tried(app: App, options: Options, by_itself: ByItself | None) -> int:
    fleet = _simulated(load_fleet(options.fleet, app)) if options.fleet else default_fleet(app)
    missions = _missions(app, fleet, options)
    if options.single:
        return _once_more(app, fleet, options, missions)
    if not missions:
        for sentence in idle_actions(app, fleet):
            output.tell(f"{options.fleet or app.name}: warning: {sentence}, so it is not tried")
    tally = Tally()
    progress = trial_progress(lines=not options.json)
    way = _Extent()

    def enough(tally: Tally) -> bool:
        progress.update(tally.runs / way.runs, _so_far(tally, way, options))
        return len(tally.findings) >= MOST_FINDINGS

    def fails(case: Case) -> bool:
        progress.update(1.0, f"{_so_far(tally, way, options)}: making the first one smaller")
        return the_same(case)

    smallest: Finding | None = None
    interrupted = False
    try:
        explored(app, _cases(app, fleet, options, missions, way), tally, enough)
        if tally.findings:
            the_same = shows_the_same(app, tally.findings[0], _WRONG)
            smallest = _smallest(app, tally.findings[0], fails)
            if smallest and by_itself and not _shows(app, smallest, by_itself):
                smallest = None
    except KeyboardInterrupt:
        if not tally.runs:
            raise
        interrupted = True  # what was found so far is reported
    finally:
        progress.clear()
    if not tally.runs:
        raise BadInput("the fleet can fly none of the missions that were drawn: use --missions")
    if options.json:
        output.line(dumped(findings_data(app, tally, smallest)))
    else:
        for line in report(app, options, tally, smallest, interrupted=interrupted):
            output.line(line)
    if interrupted:
        raise KeyboardInterrupt
    return FOUND if tally.findings else 0


def _simulated(fleet: FleetFile) -> FleetFile:
    """Return the fleet without its settings for real drones."""
    plain = FleetFile(airspace=fleet.airspace, drones=())
    return replace(
        fleet,
        navigation=plain.navigation,
        options=plain.options,
        localization=plain.localization,
        localization_options=plain.localization_options,
        drones=tuple(
            DroneEntry(id=drone.id, category=drone.category, home=drone.home)
            for drone in fleet.drones
        ),
    )


@dataclass(slots=True)
class _Extent:
    """The progress of the work."""

    seeds: int = 0
    """The number of seeds begun."""
    runs: float = inf
    """The expected number of runs, as far as known."""


def _cases(
    app: App, fleet: FleetFile, options: Options, missions: Sequence[Mission[Any]], way: _Extent
) -> Iterator[Case]:
    known = options.seeds
    for seed in range(options.seed, options.seed + options.seeds):
        way.seeds += 1
        ahead = min(options.seeds, STRUCK_EVERYWHERE) - way.seeds
        yield random_case(app, fleet, seed, missions)
        if ahead >= 0:
            struck = list(everywhere(app, small_case(app, fleet, seed, missions)))
            known += len(struck)
            way.runs = known + ahead * len(struck)
            yield from struck


def _so_far(tally: Tally, way: _Extent, options: Options) -> str:
    found = counted(len(tally.findings), "mistake")
    return f"{counted(tally.runs, 'run')}, seed {way.seeds} of {options.seeds}, {found} found"


def _smallest(app: App, first: Finding, fails: Callable[[Case], bool]) -> Finding | None:
    """Shrink a finding to a small case with the same violation; None: its own case does not reproduce it."""
    if not fails(first.case):
        return None
    small = shrunk(first.case, fails)
    return Finding(case=small, sentences=first_the_same(first, tried(app, small).wrong))


def _shows(app: App, small: Finding, by_itself: ByItself) -> bool:
    """Return whether a case shows it in a new process, without state left by earlier runs."""
    with TemporaryDirectory() as folder:
        missions, fleet = Path(folder) / "missions.toml", Path(folder) / "fleet.toml"
        missions.write_text(missions_text(app, small.case.missions), encoding="utf-8")
        fleet.write_text(fleet_text(small.case.fleet), encoding="utf-8")
        return by_itself(repeated(small.case, missions, fleet)) == FOUND


def _once_more(
    app: App, fleet: FleetFile, options: Options, missions: Sequence[Mission[Any]]
) -> int:
    drawn = small_case(app, fleet, options.seed, missions)
    case = Case(
        seed=options.seed,
        missions=drawn.missions,
        fleet=fleet,
        weather=options.weather or FAIR,
        strikes=options.strike or (),
    )
    trial = tried(app, case)
    if options.json:
        tally = Tally(runs=1, rows=trial.rows, lives=trial.lives, fired=trial.fired)
        finding = Finding(case=case, sentences=trial.wrong) if trial.wrong else None
        output.line(dumped(findings_data(app, tally, finding)))
    else:
        for line in shown_again(trial):
            output.line(line)
    return FOUND if trial.wrong else 0


def _missions(app: App, fleet: FleetFile, options: Options) -> list[Mission[Any]]:
    """Return the missions of the file, if any; endless repetitions are limited to one."""
    if options.missions is None:
        return []
    missions = load_missions(options.missions, app, fleet.airspace, fleet.landmarks)
    found = problems(missions, app, fleet, fleet.airspace)
    if found:
        raise BadInput("\n".join(f"{options.missions}: {sentence}" for sentence in found))
    missions = deepcopy(missions)
    for one in app.fields:
        if one.on is Entity.MISSION and one.type is FieldType.ROUNDS:
            for mission in missions:
                if getattr(mission, one.name) is True:
                    setattr(mission, one.name, 1)
    return missions


SEEDS = 100


@dataclass
class Options:
    """The parsed options. No slots: argparse sets further attributes."""

    file: Path = field(default_factory=Path)
    """The app's file, as given."""
    missions: Path | None = None
    fleet: Path | None = None
    seeds: int = SEEDS
    seed: int = 0
    strike: tuple[Strike, ...] | None = None
    weather: Weather | None = None
    json: bool = False

    @property
    def single(self) -> bool:
        """Whether a single case is to be repeated."""
        return self.strike is not None or self.weather is not None


_USAGE = """plutoc test [-h] [--seeds N] [--seed N] [--missions M.toml]
                   [--fleet F.toml] [--strike WHAT@ROW,…]
                   [--weather WHAT=HOW,…] [--json]
                   FILE"""
"""The usage of `plutoc test`, which is what the user has typed."""


def parse(argv: Sequence[str]) -> Options:
    """Read the command line; raise SystemExit, as argparse does, after an error."""
    parser = ArgumentParser(prog="plutoc test", usage=_USAGE, allow_abbrev=False)
    parser.add_argument("--file", type=Path)
    parser.add_argument("--seeds", type=whole_number(1))
    parser.add_argument("--seed", type=whole_number())
    parser.add_argument("--missions", type=Path)
    parser.add_argument("--fleet", type=Path)
    parser.add_argument("--strike", type=typed(strikes_of))
    parser.add_argument("--weather", type=typed(weather_of))
    parser.add_argument("--json", action="store_true")
    return parser.parse_args(argv, namespace=Options())


_MOST_EVENTS = 200
_WAS_INTERRUPTED = "It was interrupted before that was made smaller."
_VANISHED = (
    "It could not be made smaller: flown once more by itself, the case did not show it. What your own"
    " code does must hang on something else, such as a clock, chance, or what an earlier run has left"
    " behind."
)


def report(
    app: App, options: Options, tally: Tally, smallest: Finding | None, *, interrupted: bool = False
) -> Iterator[str]:
    """Yield the lines for a person."""
    struck = [what for what in WORDS if tally.fired[what]]
    yield from table(
        ("what went wrong on purpose", "times", "written"),
        [(WORDS[what], str(tally.fired[what]), WRITTEN.get(what, "")) for what in struck],
        right=(1,),
    )
    never = [words for what, words in WORDS.items() if not tally.fired[what]]
    if never and not tally.findings and not interrupted:  # else it ended too soon for most
        few = " or of more seeds" if options.seeds < SEEDS else ""
        yield f"Never happened, for want of an occasion{few}: {'; '.join(never)}."
    yield ""
    yield from _outcomes(tally)
    if not tally.findings:
        yield "No run did what no run may do" + (
            " until it was interrupted." if interrupted else "."
        )
        return
    first = tally.findings[0]
    found = counted(len(tally.findings), "run")
    yield f"Something is wrong, in {found}. What was found first:"
    yield ""
    yield from _said(first)
    yield ""
    vanished = smallest is None and not interrupted
    yield "It was found in this case:" if vanished else "See it again:"
    yield "  " + _again(options, first)
    yield from _others(tally.findings)
    yield ""
    if smallest is None:
        yield _VANISHED if vanished else _WAS_INTERRUPTED
        return
    yield "The smallest case that shows the same:"
    yield ""
    yield from smallest_case(app, options, smallest)


def _outcomes(tally: Tally) -> Iterator[str]:
    runs = counted(tally.runs, "run")
    missions = counted(tally.missions.total(), "mission")
    again = tally.lives - tally.runs
    yield f"{runs}, in which the app was started anew {counted(again, 'time')} after it had died or was stopped."
    ends = [
        f"{count} {words if count > 1 else words.replace('were ', 'was ')}"
        for end, words in ENDS.items()
        if (count := tally.missions[end])
    ]
    yield f"{missions} ended: {', '.join(ends) or 'none'}."


def _said(finding: Finding) -> Iterator[str]:
    return (f"  {printable(sentence)}" for sentence in finding.sentences)


def _others(findings: Sequence[Finding]) -> Iterator[str]:
    """Yield the other findings, each once."""
    alike = MistakeKinds(findings[0].case)
    known = {alike.kind(sentence) for sentence in findings[0].sentences}
    new: list[str] = []
    for finding in findings[1:]:
        alike = MistakeKinds(finding.case)
        for sentence in finding.sentences:
            if alike.kind(sentence) not in known:
                known.add(alike.kind(sentence))
                new.append(f"  {printable(sentence)} (seed {finding.case.seed})")
    if new:
        yield ""
        yield "Found later, and not looked into:"
        yield from new


def smallest_case(app: App, options: Options, finding: Finding) -> Iterator[str]:
    """Yield the violation, the case's files, and the command that repeats it."""
    case = finding.case
    yield from _said(finding)
    yield ""
    yield "# failing.toml"
    yield from missions_text(app, case.missions).rstrip().split("\n")
    yield ""
    yield "# failing-fleet.toml"
    yield from fleet_text(case.fleet).rstrip().split("\n")
    yield ""
    yield "Save that, and see it again:"
    small = replace(options, missions=Path("failing.toml"), fleet=Path("failing-fleet.toml"))
    yield "  " + _again(small, finding)


def _again(options: Options, finding: Finding) -> str:
    """Return the command that repeats a case, with its files."""
    words = repeated(finding.case, options.missions, options.fleet)
    return " ".join(map(in_shell, ["plutoc", "test", options.file, *words]))


def repeated(case: Case, missions: Path | None, fleet: Path | None) -> list[str]:
    """Return the arguments that repeat a case."""
    words: list[str] = []
    for flag, path in (("--missions", missions), ("--fleet", fleet)):
        words += [] if path is None else [flag, str(path)]
    words += ["--seed", str(case.seed)]
    weather = weather_text(case.weather)
    if case.strikes or not weather:
        words += ["--strike", strikes_text(case.strikes) or "-"]
    if weather:
        words += ["--weather", weather]
    return words


def shown_again(trial: TrialResult) -> Iterator[str]:
    """Yield the events of a case, and its violations."""
    lines = [line for event in trial.events if (line := line_of(event)) is not None]
    yield from lines[-_MOST_EVENTS:]
    yield ""
    for sentence in trial.wrong:
        yield printable(sentence)
    if not trial.wrong:
        yield "This run did nothing that no run may do."


def findings_data(app: App, tally: Tally, smallest: Finding | None) -> dict[str, object]:
    """Return the object that `--json` prints."""
    return {
        "app": app.name,
        "runs": tally.runs,
        "lives": tally.lives,
        "rows": tally.rows,
        "missions": dict(sorted(tally.missions.items())),
        "struck": dict(sorted(tally.fired.items())),
        "findings": [
            {
                "seed": finding.case.seed,
                "what": list(finding.sentences),
                "strike": strikes_text(finding.case.strikes),
                "weather": weather_text(finding.case.weather),
            }
            for finding in tally.findings
        ],
        "smallest": None if smallest is None else _data(app, smallest),
    }


def _data(app: App, finding: Finding) -> dict[str, object]:
    case = finding.case
    return {
        "what": list(finding.sentences),
        "seed": case.seed,
        "strike": strikes_text(case.strikes),
        "weather": weather_text(case.weather),
        "missions": missions_text(app, case.missions),
        "fleet": fleet_text(case.fleet),
    }
