"""Imports somebody's module in a process of its own first: it may hang, or end whoever imports it."""

from __future__ import annotations

import signal
import subprocess
import sys
from contextlib import suppress
from tempfile import TemporaryFile
from typing import IO, TYPE_CHECKING

from . import refusals
from .timeouts import shortened

if TYPE_CHECKING:
    from .kinds import Kind

LIMIT = 20.0
"""Seconds that an import may take."""

_SEEN = 93
"""How the process ends that has seen the import to its end; if that has raised, so it will here."""

_PROGRAM = "\n".join(
    (
        "import os, sys",
        "from importlib import import_module",
        "name, *sys.path = sys.argv[1:]",
        "try:",
        "    import_module(name)",
        "except BaseException:",
        "    pass",
        f"os._exit({_SEEN})",
    )
)


def tried(kind: Kind, name: str, module: str) -> None:
    """Raise `BadInput` if the import of a module does not end, or does not come back."""
    if module in sys.modules:
        return
    command = [sys.executable, "-c", _PROGRAM, module, *sys.path]
    with TemporaryFile() as said:
        try:
            code = subprocess.run(
                command,
                stdin=subprocess.DEVNULL,
                stdout=said,
                stderr=said,
                timeout=LIMIT,
                check=False,
            ).returncode
        except subprocess.TimeoutExpired:
            raise refusals.hangs(kind, name, module, LIMIT, _last_of(said)) from None
        if code != _SEEN:
            raise refusals.ends_all(kind, name, module, _how(code), _last_of(said))


def _how(code: int) -> str:
    with suppress(ValueError):
        return f"killed by {signal.Signals(-code).name}"
    return f"exit code {code}"


def _last_of(said: IO[bytes]) -> str:
    """Return the last line that was said, if anything was."""
    said.seek(0)
    lines = said.read().decode("utf-8", "replace").strip().splitlines()
    return shortened(lines[-1]) if lines else ""
