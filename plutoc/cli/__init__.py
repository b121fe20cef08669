"""The command line of the compiler."""

from __future__ import annotations

import gc
import os
import sys
from contextlib import contextmanager
from errno import ENAMETOOLONG

from plutoc.cli.endings import (
    CLEAN,
    CLOSED_PIPE,
    ERRORS,
    INTERNAL,
    INTERRUPTED,
    REFUSED,
    USAGE,
    Unusable,
)
from plutoc.terminated import Terminated
from plutoc_runtime import output

TYPE_CHECKING = False  # `typing` itself is slow to import, and `--version` does without
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plutoc.cli.options import Options


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; `argv` is without the program."""
    output.prepare()
    ending = _Ending()
    with ending, _seldom_collecting():
        ending.code = _command(argv)
        output.flush()
    return ending.code


@contextmanager
def _seldom_collecting() -> Iterator[None]:
    """Look for garbage less often: a compiler builds much and drops little before it ends.

    Python's own measure would have it spend half of its time on looking. What was built until then
    counts as old afterwards, or Python would look at all of it once more, right before the end.
    """
    before = gc.get_threshold()
    gc.set_threshold(1_000_000, *before[1:])
    try:
        yield
    finally:
        gc.freeze()
        gc.unfreeze()
        gc.set_threshold(*before)


class _Ending:
    """Turns whatever a command ends with into an exit code, and into a message."""

    def __init__(self) -> None:
        self.code = CLEAN

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        match error:
            case None:
                return True
            case Unusable():
                output.tell(f"plutoc: {error}")
                self.code = USAGE
            case OSError() if error.errno == ENAMETOOLONG:
                from plutoc_runtime.domain.text import printable

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


def _command(argv: Sequence[str] | None) -> int:
    """Import as little as will do: one who asks for the version shall not wait for the rest."""
    arguments = sys.argv[1:] if argv is None else list(argv)
    if arguments == ["--version"]:
        from plutoc.cli.version import tell_version

        tell_version()
        return CLEAN
    if arguments[:1] == ["compile"]:
        from plutoc.cli.unchanged import said_again

        if said_again(arguments):
            return CLEAN
    from plutoc.cli.options import parse
    from plutoc.cli.say import say
    from plutoc.cli.termination import tidy_when_told_to_end
    from plutoc.diagnostic import Rejected

    try:
        options = parse(arguments)
    except SystemExit as end:  # the help or the version is printed, or what is wrong
        return end.code if isinstance(end.code, int) else USAGE
    options.arguments = tuple(arguments)
    try:
        with tidy_when_told_to_end():
            return _run(options)
    except Rejected as rejected:
        from plutoc.emit.write import Refused

        say(rejected.diagnostics, options.format)
        return REFUSED if isinstance(rejected, Refused) else ERRORS


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
        case "run":
            from plutoc.cli.run import run

            return run(options)
        case "test":
            from plutoc.cli.test import test

            return test(options)
        case "fmt":
            from plutoc.cli.fmt import fmt

            return fmt(options)
        case "graph":
            from plutoc.cli.graph import graph

            return graph(options)
        case "diff":
            from plutoc.cli.diff import diff

            return diff(options)
        case "explain":
            from plutoc.cli.explain import explain

            return explain(options)
        case _:
            from plutoc.cli.blocks import blocks

            return blocks(options)


def _report_bug(error: BaseException) -> None:
    if os.environ.get("PLUTO_DEBUG") == "1":
        import traceback

        output.tell("".join(traceback.format_exception(error)).rstrip())
    output.tell(
        f"plutoc: internal error (P9001): {type(error).__name__}: {error}\n"
        "This is a mistake of ours: please report it, with your source if you can"
        " (PLUTO_DEBUG=1 shows where it happened)."
    )
