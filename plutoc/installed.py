"""Packages that are installed, told apart by what pip or a developer did to their files.

By the size and the time of each file, that is: so nothing needs to be imported or read.
"""

from __future__ import annotations

import os
import sys
from hashlib import sha256
from operator import attrgetter

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from importlib.machinery import ModuleSpec

_name = attrgetter("name")
_last: dict[str, list[str]] = {}


def folders_of(package: str) -> list[str]:
    """Return where a package is, without importing it."""
    spec = _spec(package)
    return list(spec.submodule_search_locations or ()) if spec else []


def files_of(package: str) -> Iterator[str]:
    """Yield all files of a package, without importing it."""
    for folder in folders_of(package):
        yield from files_in(folder)


def files_in(folder: str) -> Iterator[str]:
    """Yield all files in a folder and in those within it, but for what Python keeps there."""
    for entry in _entries(folder):
        yield entry.path


def facts_of_package(package: str) -> list[str]:
    """Return a line for each file of a package; a module that is in none has only one."""
    spec = _spec(package)
    if spec and spec.submodule_search_locations:
        entries = [one for folder in spec.submodule_search_locations for one in _entries(folder)]
        found = [_line(entry.path, entry.stat()) for entry in entries]
    else:
        found = [fact(spec.origin)] if spec and spec.origin else []
    _last[package] = found
    return found


def last_facts_of_package(package: str) -> list[str]:
    """Return what was true of a package when it was looked at last."""
    return _last.get(package) or facts_of_package(package)


def facts_of_release(package: str) -> Iterator[str]:
    """Yield what tells which release of a package it is: enough for those that nobody works on."""
    for folder in folders_of(package):
        yield fact(os.path.join(folder, "__init__.py"))
        # the release is in the name of a folder beside it
        beside = sorted(os.listdir(os.path.dirname(folder)))
        yield from (one for one in beside if one.startswith(f"{package}-"))


def _spec(package: str) -> ModuleSpec | None:
    """Ask whoever finds packages here: what developers install may have a finder of its own."""
    for finder in sys.meta_path:
        spec = finder.find_spec(package, None)
        if spec is not None:
            return spec
    return None


def fact(path: str) -> str:
    """Return a line that changes with a file or a folder, or where there is none."""
    try:
        return _line(path, os.stat(path))
    except OSError:
        return path


def digest(facts: Iterable[str]) -> bytes:
    """Return some facts in 32 bytes."""
    return sha256("\n".join(facts).encode("utf-8", "surrogateescape")).digest()


def _entries(folder: str) -> list[os.DirEntry[str]]:
    """Return each file in a folder, and in those within it, in one order."""
    with os.scandir(folder) as entries:
        found = sorted(entries, key=_name)
    files: list[os.DirEntry[str]] = []
    for entry in found:
        if not entry.is_dir():
            files.append(entry)
        elif entry.name != "__pycache__":
            files += _entries(entry.path)
    return files


def _line(path: str, facts: os.stat_result) -> str:
    return f"{path} {facts.st_size} {facts.st_mtime_ns}"
