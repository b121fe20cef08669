"""The command line of the compiler."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from errno import ENAMETOOLONG

from plutoc.cli.endings import (
    CLEAN,
    CLOSED_PIPE,
    ERRORS,
    INTERNAL,
    INTERRUPTED,
    REFUSED,
    USAGE,
    UsageError,
    tidy_when_told_to_end,
)
from plutoc.cli.options import Options, all_commands, parse
from plutoc.cli.say import say
from plutoc.diagnostic import Rejected
from plutoc.foreign_code import Terminated
from plutoc.mistake import traceback_of
from plutoc_runtime import output
from plutoc_runtime.domain.text import printable


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; `argv` is without the program."""
    output.prepare()
    ending = _ExitCode()
    before = gc.get_threshold()
    # A compiler builds much and drops little: else half of its time goes into looking for garbage.
    gc.set_threshold(1_000_000, *before[1:])
    with ending:
        ending.code = _command(sys.argv[1:] if argv is None else argv)
        output.flush()
    gc.set_threshold(*before)
    return ending.code


class _ExitCode:
    """Turns what a command ends with into an exit code, and into a message."""

    def __init__(self) -> None:
        self.code = CLEAN

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        match error:
            case None:
                return True
            case UsageError():
                output.tell(f"plutoc: {error}")
                self.code = USAGE
            case OSError() if error.errno == ENAMETOOLONG:
                output.tell(f"plutoc: {printable(str(error.filename))}: a name is too long")
                self.code = USAGE
            case output.ClosedPipe():
                output.silence()
                self.code = CLOSED_PIPE
            case output.CannotWrite():
                output.silence()
                output.tell(f"plutoc: the output cannot be written: {error}")
                self.code = USAGE
            case KeyboardInterrupt():
                output.tell("plutoc: interrupted")
                self.code = INTERRUPTED
            case Terminated():
                output.tell("plutoc: terminated")
                self.code = error.code
            case _:  # even a SystemExit: it would pass for a proper end
                _report_bug(error)
                self.code = INTERNAL
        return True


def _command(arguments: Sequence[str]) -> int:
    if "_ARGCOMPLETE" in os.environ:  # a shell asks which words can come next
        _complete()
    try:
        options = parse(arguments)
    except SystemExit as end:  # the help or the version is printed, or what is wrong
        return end.code if isinstance(end.code, int) else USAGE
    try:
        with tidy_when_told_to_end():
            return _run(options)
    except Rejected as rejected:
        from plutoc.emit.write import Refused

        say(rejected.diagnostics, options.format)
        return REFUSED if isinstance(rejected, Refused) else ERRORS


def _complete() -> None:
    """Answer, and end; or do nothing, where argcomplete is installed for other programs only."""
    from importlib.util import find_spec

    if find_spec("argcomplete") is not None:
        from plutoc.cli.completion import complete

        complete(all_commands())


def _run(options: Options) -> int:
    """Each command imports what it needs, when it is called."""
    match options.command:
        case "new":
            from plutoc.cli.new import new

            return new(options)
        case "check":
            from plutoc.cli.check import check

            return check(options)
        case "compile":
            from plutoc.cli.compile import compile_

            return compile_(options)
        case "watch":
            from plutoc.cli.watch import watch

            return watch(options)
        case "run":
            from plutoc.cli.run import run

            return run(options)
        case "test":
            from plutoc.cli.run import test

            return test(options)
        case "fmt":
            from plutoc.cli.fmt import fmt

            return fmt(options)
        case "graph":
            from plutoc.cli.show import graph

            return graph(options)
        case "edit":
            from plutoc.cli.edit import edit

            return edit(options)
        case "diff":
            from plutoc.cli.diff import diff

            return diff(options)
        case "lsp":
            from plutoc.cli.lsp import lsp

            return lsp(options)
        case "explain":
            from plutoc.cli.show import explain

            return explain(options)
        case _:
            from plutoc.cli.show import blocks

            return blocks(options)


def _report_bug(error: BaseException) -> None:
    if where := traceback_of(error):
        output.tell(where)
    output.tell(
        f"plutoc: internal error (P9001): {type(error).__name__}: {error}\n"
        "This is a mistake of ours: please report it, with your source if you can"
        " (PLUTO_DEBUG=1 shows where it happened)."
    )
