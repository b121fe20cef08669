"""The library as an installer leaves it: with its own copy of the brain, and no app nor compiler beside it."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import tomlkit

import pluto_fleet

_PROGRAM = (
    "import sys; sys.path[:0] = sys.argv[1:3]; del sys.argv[1:3]; "
    "from pluto_fleet.__main__ import main; sys.exit(main())"
)


def installed(folder: Path) -> tuple[str, ...]:
    """Install the library, and what it needs, into a folder; return the command of its program.

    Nothing else is on that program's path, and no variable of the environment changes that.
    """
    no_caches = shutil.ignore_patterns("__pycache__")
    library = folder / "pluto_fleet"
    shutil.copytree(pluto_fleet.__path__[0], library, ignore=no_caches)
    needed = folder / "needed"
    shutil.copytree(tomlkit.__path__[0], needed / "tomlkit", ignore=no_caches)
    return (sys.executable, "-I", "-S", "-c", _PROGRAM, str(folder), str(needed))
