"""The apps in folders that are named in the place of files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from plutoc.project.reading import shown

_ENVIRONMENT = "pyvenv.cfg"
"""What lies at the top of each virtual environment."""


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
        troubles.append(f"the folder {where} cannot be read: {error.strerror or error}")

    for where, folders, files in os.walk(folder, onerror=unreadable):
        here = Path(where)
        folders[:] = sorted(name for name in folders if _is_looked_into(here / name))
        apps = (here / name for name in sorted(files) if name.endswith(".pluto"))
        yield from (app for app in apps if not os.path.islink(app))


def _is_looked_into(folder: Path) -> bool:
    return not (folder.name.startswith(".") or os.path.exists(folder / _ENVIRONMENT))
