"""`check`: what is wrong with apps."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from plutoc.cli.endings import CLEAN, ERRORS, USAGE, UsageError
from plutoc.cli.files import STANDARD_INPUT, apps_of, read_app, read_standard_input
from plutoc.cli.options import Options
from plutoc.cli.say import say
from plutoc.compile import analyse, check_hooks
from plutoc.diagnostic import Diagnostic, Rejected, Severity
from plutoc.project.hooks import default_folder, find_hooks
from plutoc.source import Source
from plutoc_runtime import output


def check(options: Options) -> int:
    """Check every file, and those in every folder, and say what was found in all of them."""
    found: list[Diagnostic] = []
    troubles: list[str] = []
    for file in apps_of(options.files, troubles):
        try:
            found += _check(file, options, troubles)
        except UsageError as error:
            troubles.append(str(error))
    for sentence in troubles:
        output.tell(f"plutoc: {sentence}")
    say(found, options.format, troubles)
    if troubles:
        return USAGE
    return ERRORS if _have_errors(found) else CLEAN


def _check(file: Path, options: Options, troubles: list[str]) -> tuple[Diagnostic, ...]:
    """Return what is wrong with a file; with --fix, what is still wrong."""
    source = read_standard_input() if file == STANDARD_INPUT else read_app(file)
    findings = _findings(file, source)
    if options.fix and any(diagnostic.fix for diagnostic in findings.found):
        try:
            findings = _fixed(file, source, options)
        except UsageError as error:  # what is wrong with it is told all the same
            troubles.append(str(error))
    if options.format == "text" and not _have_errors(findings.found):
        output.line(f"{source.path}: no errors, in all {findings.explored} states of a mission")
    return findings.found


@dataclass(frozen=True, slots=True, kw_only=True)
class _Findings:
    """What was found, and at what cost."""

    found: tuple[Diagnostic, ...]
    explored: int
    """How many states of a mission were looked at: what the answer has cost."""


def _findings(file: Path, source: Source) -> _Findings:
    """Return what is wrong with an app, and with the developer's code where there is any."""
    found: tuple[Diagnostic, ...] = ()
    explored = 0
    try:
        checked, found = analyse(source)
        explored = checked.explored
        if file != STANDARD_INPUT:  # beside that lies nothing
            hooks = find_hooks(checked.graph, file, default_folder(file, checked.graph))
            found += check_hooks(checked, hooks)
    except Rejected as rejected:
        found += rejected.diagnostics
    return _Findings(found=found, explored=explored)


def _fixed(file: Path, source: Source, options: Options) -> _Findings:
    """Mend a file, say what was mended, and return what is left."""
    from plutoc.cli.changes import rewrite
    from plutoc.cli.fix import mended, summary

    if file == STANDARD_INPUT:
        raise UsageError("--fix changes files, and standard input is none")
    done = mended(source, lambda mended: _findings(file, mended).found)
    if done.fixed:
        rewrite(file, source.text, done.source.text)
        tell = output.line if options.format == "text" else output.tell
        tell(summary(done))
    return _findings(file, done.source)


def _have_errors(found: Iterable[Diagnostic]) -> bool:
    return any(diagnostic.severity is Severity.ERROR for diagnostic in found)
