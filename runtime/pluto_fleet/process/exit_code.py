"""The exit code of a command, and its message if it ends with an error."""

from __future__ import annotations

import os
import traceback
from errno import ENAMETOOLONG

from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.text import printable

BAD_INPUT, INTERNAL, INTERRUPTED, CLOSED_PIPE = 2, 70, 130, 141


class ExitCode:
    """Turns the error that a command ends with, if any, into an exit code and a message."""

    def __init__(self, name: str) -> None:
        self.code = 0
        self._name = name

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        name = self._name
        match error:
            case None:
                return True
            case BadInput():
                output.tell("\n".join(map(printable, str(error).split("\n"))))
                self.code = BAD_INPUT
            case OSError() if error.errno == ENAMETOOLONG:
                output.tell(f"{printable(str(error.filename))}: a name is too long")
                self.code = BAD_INPUT
            case output.ClosedPipe():
                output.silence()
                self.code = CLOSED_PIPE
            case output.CannotWrite():
                output.silence()
                output.tell(f"{name}: the output cannot be written: {error}")
                self.code = BAD_INPUT
            case KeyboardInterrupt():
                output.tell(f"{name}: interrupted")
                self.code = INTERRUPTED
            case _:  # even a SystemExit: it would pass for a proper end
                _report_bug(name, error)
                self.code = INTERNAL
        return True


def _report_bug(name: str, error: BaseException) -> None:
    if os.environ.get("PLUTO_DEBUG") == "1":
        output.tell("".join(traceback.format_exception(error)).rstrip())
    where = getattr(error, "__notes__", ())  # the block, if it was in one
    whose = "of ours, or of that block's author" if where else "of ours"
    output.tell(
        "\n".join([f"{name}: internal error: {type(error).__name__}: {error}", *where])
        + f"\nThis is a mistake {whose}: please report it"
        " (PLUTO_DEBUG=1 shows where it happened)."
    )
