"""`fmt`: sources in canonical form."""

from __future__ import annotations

import sys
from pathlib import Path

from plutoc.cli.changes import rewrite
from plutoc.cli.endings import CLEAN, ERRORS, USAGE, UsageError
from plutoc.cli.files import STANDARD_INPUT, apps_of, read_app, read_standard_input
from plutoc.cli.options import Options
from plutoc.cli.say import say
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.emit.write import Change, Changes
from plutoc.format.run import TooLarge, format_source
from plutoc.project.patch import patch
from plutoc.project.reading import shown
from plutoc.source import LARGEST, Source
from plutoc_runtime import output


def fmt(options: Options) -> int:
    """Format every file, and those in every folder; what is wrong with one does not stop the others."""
    if STANDARD_INPUT in options.files and len(options.files) > 1:
        raise UsageError("`-`, standard input, cannot be formatted together with files")
    found: list[Diagnostic] = []
    troubles: list[str] = []
    code = CLEAN
    for file in apps_of(options.files, troubles):
        try:
            code = max(code, _format(file, options))
        except UsageError as error:
            troubles.append(str(error))
        except Rejected as rejected:
            found += rejected.diagnostics
            code = max(code, ERRORS)
    for sentence in troubles:
        output.tell(f"plutoc: {sentence}")
    say(found)
    return USAGE if troubles else code


def _format(file: Path, options: Options) -> int:
    """Format one file, or say what would change, and return the exit code."""
    from_stdin = file == STANDARD_INPUT
    source = read_standard_input() if from_stdin else read_app(file)
    after = _formatted(source)
    changed = after != source.text
    writes = not (options.check or options.diff)
    if options.diff:
        _write_exactly("".join(line + "\n" for line in patch(_changes(source, after))))
    if options.check and changed:
        mend = "" if from_stdin else f": `plutoc fmt {source.path}` does it"
        output.tell(f"{source.path} is not in canonical form{mend}")
        return ERRORS
    if from_stdin and writes:
        _write_exactly(after)
    elif changed and writes:
        rewrite(file, source.text, after)
    if not (from_stdin or options.diff):
        output.line(f"{shown(file)}: {'formatted' if changed else 'nothing to change'}")
    return CLEAN


def _formatted(source: Source) -> str:
    try:
        return format_source(source)
    except TooLarge:
        raise UsageError(
            f"{source.path} would be larger than {LARGEST // 1024} KiB in canonical form,"
            " which the compiler does not read; it was not changed"
        ) from None


def _changes(source: Source, after: str) -> Changes:
    change = Change(path=source.path.lstrip("/"), before=source.text, after=after)
    files = (change,) if after != source.text else ()
    return Changes(folder=Path(), first=False, files=files)


def _write_exactly(text: str) -> None:
    """Write what may become a source again: in UTF-8, whether a terminal knows it or not."""
    output.flush()
    try:
        if sys.stdout is not None:
            sys.stdout.buffer.write(text.encode())
            sys.stdout.buffer.flush()
    except BrokenPipeError as error:
        raise output.ClosedPipe from error
    except OSError as error:
        raise output.CannotWrite(error.strerror or str(error)) from error
