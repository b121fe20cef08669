"""Starting an app's program again, or the library's own, as another process."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

_START = (
    "import sys; from importlib import import_module as load; "
    "home, name, also = sys.argv[1:4]; del sys.argv[1:4]; "
    "sys.path.insert(0, home); load(name); sys.path += [sys.path.pop(0), also]; "
    "sys.exit(load(name + '.__main__').main())"
)
"""Imports the package from where it was found now, even if another has its name."""

LIBRARY = "pluto_fleet"


def command(package: str, *arguments: str) -> list[str]:
    """Return the command line that starts a package's program with these arguments."""
    return _command(package, _home(package), *arguments)


def library(*arguments: str, beside: str = LIBRARY) -> list[str]:
    """Return the command line that starts the library's own program, which imports no app.

    What lies `beside` an app's package, such as a navigation of its own, is found there as it is here.
    """
    return _command(LIBRARY, _home(beside), *arguments)


def _command(package: str, also: str, *arguments: str) -> list[str]:
    return [sys.executable, "-P", "-c", _START, _home(package), package, also, *arguments]


def _home(package: str) -> str:
    return str(Path(sys.modules[package].__path__[0]).absolute().parent)


def start(command: Sequence[str], log: Path) -> subprocess.Popen[bytes]:
    """Start a process that survives this one; its output goes to the log."""
    with log.open("ab") as said:
        return subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=said, stderr=said, start_new_session=True
        )
