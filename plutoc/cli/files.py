"""The apps that the command line names: files, folders of them, standard input."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

from plutoc.project.reading import UsageError, decoded, shown, text_of, why
from plutoc.source import LARGEST, Source

STANDARD_INPUT = Path("-")
_OTHER_FILES = (".toml", ".py")
"""What lies beside an app, and is easily given in its place."""
_ENVIRONMENT = "pyvenv.cfg"
"""What lies at the top of each virtual environment."""


def read_app(path: Path) -> Source:
    """Read a `.pluto` file; raise `UsageError` where there is nothing to parse."""
    if path.suffix.lower() in _OTHER_FILES:
        raise UsageError(f"{shown(path)} is no app: an app is a file whose name ends with .pluto")
    return Source(shown(path), text_of(path))


def read_standard_input() -> Source:
    """Read an app from standard input; raise `UsageError` where there is nothing to parse."""
    name = "standard input"
    if sys.stdin is None:
        raise UsageError(f"{name} is closed")
    try:
        data = sys.stdin.buffer.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        raise UsageError(f"{name} cannot be read: {why(error)}") from None
    return Source("<stdin>", decoded(data, name))


def apps_of(named: Iterable[Path], troubles: list[str]) -> list[Path]:
    """Return each file once: those that are named, and in the place of a folder the apps below it.

    What is wrong with a folder is added to `troubles`.
    """
    found: dict[Path, None] = {}
    for path in named:
        if not os.path.isdir(path):
            found[path] = None
            continue
        known = len(troubles)
        below = dict.fromkeys(_below(path, troubles))
        if not below and len(troubles) == known:
            troubles.append(f"the folder {shown(path)} holds no app, no file that ends with .pluto")
        found |= below
    return list(found)


def _below(folder: Path, troubles: list[str]) -> Iterator[Path]:
    """Yield the apps below a folder, in the order of their names.

    Links are passed over: `fmt` would change what lies elsewhere.
    """

    def unreadable(error: OSError) -> None:
        where = shown(Path(os.fsdecode(error.filename)))
        troubles.append(f"the folder {where} cannot be read: {why(error)}")

    for where, folders, files in os.walk(folder, onerror=unreadable):
        here = Path(where)
        folders[:] = sorted(name for name in folders if _is_looked_into(here / name))
        apps = (here / name for name in sorted(files) if name.endswith(".pluto"))
        yield from (app for app in apps if not os.path.islink(app))


def _is_looked_into(folder: Path) -> bool:
    return not (folder.name.startswith(".") or os.path.exists(folder / _ENVIRONMENT))
