"""What `plutoc test` says: what struck, what was found, and the smallest case that shows it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..cli.events import line_of
from ..cli.report import table
from ..files.fleet_text import fleet_text
from ..words import counted, printable
from .blows import blows_text
from .case import weather_text
from .explore import FAULTS
from .plan_text import missions_text

if TYPE_CHECKING:
    from ..app import App
    from .book import Trial
    from .explore import Finding, Tally
    from .options import Options

_MOST_EVENTS = 200


def report(app: App, options: Options, tally: Tally, smallest: Finding | None) -> Iterator[str]:
    """Yield the lines for a person."""
    yield from table(
        ("what struck", "how often"),
        [(what, str(tally.fired[what])) for what in FAULTS],
        right=(1,),
    )
    yield ""
    ends = ", ".join(f"{times} {status}" for status, times in sorted(tally.missions.items()))
    lives = f"{counted(tally.runs, 'run')} in {counted(tally.lives, 'life', 'lives')} of the app"
    yield f"{lives}: {counted(tally.missions.total(), 'mission')} ended ({ends})"
    if smallest is None:
        yield "No run did what no run may do."
        return
    seeds = dict.fromkeys(str(finding.case.seed) for finding in tally.findings)
    yield f"Something is wrong, with seed {', '.join(seeds)}. The smallest case that shows it:"
    yield ""
    yield from smallest_case(app, options, smallest)


def smallest_case(app: App, options: Options, finding: Finding) -> Iterator[str]:
    """Yield what is wrong, the files that show it, and the command that shows it again."""
    case = finding.case
    for sentence in finding.sentences:
        yield f"  {printable(sentence)}"
    yield ""
    yield "# failing.toml"
    yield from missions_text(app, case.missions).rstrip().split("\n")
    yield ""
    yield "# failing-fleet.toml"
    yield from fleet_text(case.fleet).rstrip().split("\n")
    yield ""
    yield "Save that, and see it again:"
    yield "  " + _again(options, finding)


def _again(options: Options, finding: Finding) -> str:
    case = finding.case
    words = [
        f"plutoc test {options.file} --missions failing.toml",
        f"--fleet failing-fleet.toml --seed {case.seed}",
    ]
    weather = weather_text(case.weather)
    if case.blows or not weather:
        words.append(f"--strike {blows_text(case.blows) or '-'}")
    if weather:
        words.append(f"--weather {weather}")
    return " ".join(words)


def shown_again(trial: Trial) -> Iterator[str]:
    """Yield what happened in one case, and what of it may not be."""
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
            {"seed": finding.case.seed, "what": list(finding.sentences)}
            for finding in tally.findings
        ],
        "smallest": None if smallest is None else _data(app, smallest),
    }


def _data(app: App, finding: Finding) -> dict[str, object]:
    case = finding.case
    return {
        "what": list(finding.sentences),
        "seed": case.seed,
        "strike": blows_text(case.blows),
        "weather": weather_text(case.weather),
        "missions": missions_text(app, case.missions),
        "fleet": fleet_text(case.fleet),
    }
