"""`diff`: what changed in meaning from one app to another, in words."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from plutoc.cli.endings import CLEAN, ERRORS, UsageError
from plutoc.cli.files import STANDARD_INPUT, read_app, read_standard_input
from plutoc.cli.options import Options
from plutoc.cli.say import in_colour
from plutoc.compile import analyse
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.diff.model import Difference, Version
from plutoc.diff.run import compare
from plutoc.project.reading import shown
from plutoc.report.change_reports import json, markdown, text
from plutoc.source import Source
from plutoc_runtime import output

_APP = "app.pluto"


def diff(options: Options) -> int:
    """Say what changed; whether something did is the exit code only where that is asked for."""
    if options.old == options.new == STANDARD_INPUT:
        raise UsageError("`-`, standard input, can be one of the two apps, not both")
    sources = _sources(options.old, options.new)
    old, new = _versions(*sources)
    found = compare(old, new)
    output.line(_report(found, options.format).rstrip("\n"))
    return ERRORS if options.exit_code and found.changes else CLEAN


def _sources(old: Path, new: Path) -> tuple[Source, Source]:
    """Read both; what is no file may be the revision at which the second one is compared."""
    if STANDARD_INPUT in (old, new) or os.path.lexists(old):
        return _read(old), _read(new)
    from plutoc.cli.revisions import read_at

    file = _file(new)
    now = read_app(file)
    return read_at(os.fspath(old), file), now


def _read(path: Path) -> Source:
    if path == STANDARD_INPUT:
        source = read_standard_input()
        if not source.text:  # as of a `git show` outside a repository
            raise UsageError("standard input is empty: the command before the `|` gave no app")
        return source
    return read_app(_file(path))


def _file(path: Path) -> Path:
    return _app_in(path) if path.is_dir() else path


def _app_in(folder: Path) -> Path:
    """Return the app of a folder: `app.pluto`, or the only one there is."""
    if (folder / _APP).is_file():
        return folder / _APP
    apps = sorted(folder.glob("*.pluto"))
    if len(apps) != 1:
        found = f"several apps, none of them {_APP}: name one" if apps else "no app"
        raise UsageError(f"the folder {shown(folder)} holds {found}")
    return apps[0]


def _versions(*sources: Source) -> list[Version]:
    """Check both apps; raise `Rejected` with the errors of both."""
    versions: list[Version] = []
    found: list[Diagnostic] = []
    for source in sources:
        try:
            checked, warnings = analyse(source)
            versions.append(Version(checked=checked, warnings=warnings))
        except Rejected as rejected:
            found += rejected.diagnostics
    if found:
        raise Rejected(found)
    return versions


def _report(found: Difference, format: str) -> str:
    match format:
        case "markdown":
            return markdown(found)
        case "json":
            return json(found)
        case _:
            return text(found, colour=in_colour(sys.stdout))
