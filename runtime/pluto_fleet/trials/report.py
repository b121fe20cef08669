"""The report of `plutoc test`: the faults, the findings, and the smallest case for one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..files.fleet_text import fleet_text
from ..files.missions_text import missions_text
from ..process.text import in_shell
from ..report.sentences import line_of
from ..report.terminal import table
from ..shared.domain.text import counted, printable
from .case import ENDS, WORDS, WRITTEN, strikes_text, weather_text
from .options import SEEDS
from .shrink import MistakeKinds

if TYPE_CHECKING:
    from ..app import App
    from .case import Case
    from .explore import Finding, Tally
    from .options import Options
    from .record import TrialResult


_MOST_EVENTS = 200
_WAS_INTERRUPTED = "It was interrupted before that was made smaller."
_VANISHED = (
    "It could not be made smaller: flown once more by itself, the case did not show it. What your own"
    " code does must hang on something else, such as a clock, chance, or what an earlier run has left"
    " behind."
)


def report(
    app: App,
    options: Options,
    tally: Tally,
    smallest: Finding | None,
    *,
    interrupted: bool = False,
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
    yield from _tried(tally)
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


def _tried(tally: Tally) -> Iterator[str]:
    runs, missions = counted(tally.runs, "run"), counted(tally.missions.total(), "mission")
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
