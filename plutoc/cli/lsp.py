"""`lsp`: the language server, for editors, on standard input and output."""

from __future__ import annotations

import os
import sys

from plutoc.cli.endings import CLEAN, UsageError, end_at_once_when_told
from plutoc.cli.options import Options

_EXTRA = ("pygls", "lsprotocol", "cattrs")


def lsp(_: Options) -> int:
    """Serve the editor that started this program."""
    try:
        from plutoc.lsp.server import serve
    except ModuleNotFoundError as error:
        if error.name and error.name.partition(".")[0] in _EXTRA:
            raise UsageError('lsp needs a library: pip install "plutoc[editor]"') from None
        raise
    if sys.stdin is None or sys.stdout is None:
        raise UsageError("an editor starts this, and speaks to it by standard input and output")
    reads, writes = sys.stdin.buffer, os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(2, sys.stdout.fileno())  # what a block of another package prints is no message
    end_at_once_when_told("plutoc")  # one thread waits for the editor, and hears no signal
    serve(reads, writes)
    return CLEAN
