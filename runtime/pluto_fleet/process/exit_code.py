"""The exit code of a command, and its message if it ends with an error."""

from __future__ import annotations

import os
import traceback
from collections.abc import Callable
from errno import ENAMETOOLONG

from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.text import printable

BAD_INPUT, INTERNAL, INTERRUPTED, CLOSED_PIPE = 2, 70, 130, 141


def exit_code(name: str, run: Callable[[], int]) -> int:
    """Run a command, and return its exit code; the error that it ends with, if any, becomes a message."""
    try:
        code = run()
        output.flush()
        return code
    except BadInput as error:
        output.tell("\n".join(map(printable, str(error).split("\n"))))
        return BAD_INPUT
    except output.ClosedPipe:
        output.silence()
        return CLOSED_PIPE
    except output.CannotWrite as error:
        output.silence()
        output.tell(f"{name}: the output cannot be written: {error}")
        return BAD_INPUT
    except KeyboardInterrupt:
        output.tell(f"{name}: interrupted")
        return INTERRUPTED
    except BaseException as error:  # noqa: BLE001 - a SystemExit would pass for a proper end
        if isinstance(error, OSError) and error.errno == ENAMETOOLONG:
            output.tell(f"{printable(str(error.filename))}: a name is too long")
            return BAD_INPUT
        _report_bug(name, error)
        return INTERNAL


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
