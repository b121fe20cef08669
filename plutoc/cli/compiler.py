"""Which compiler this is: what changes whenever it, or what it works with, is another one."""

from __future__ import annotations

import os
import sys
from hashlib import sha256
from importlib.machinery import PathFinder

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

OURS = ("plutoc", "plutoc_grammar", "plutoc_runtime", "plutoc_blocks")
"""Packages of which every file counts."""
TOOLS = ("black", "jinja2")
"""Packages of which the release counts, and whatever else pip did to them."""


def identity() -> bytes:
    """Return the identity of this compiler, and of the Python that it runs on.

    A package counts by the size and the time of each of its files, so that a checkout that somebody
    works on is another compiler after each change.
    """
    facts = [sys.version, sys.executable, str(sys.flags.optimize)]
    for name in OURS:
        for folder in folders_of(name):
            facts += [_line(entry.path, entry.stat()) for entry in _entries(folder)]
    for name in TOOLS:
        for folder in folders_of(name):
            facts.append(_fact(os.path.join(folder, "__init__.py")))
            # the release is in the name of a folder beside it
            beside = sorted(os.listdir(os.path.dirname(folder)))
            facts += [one for one in beside if one.startswith(f"{name}-")]
    return _digest(facts)


def folders_of(package: str) -> list[str]:
    """Return where a package is, without importing it."""
    spec = PathFinder.find_spec(package)
    return list(spec.submodule_search_locations or ()) if spec else []


def files_of(package: str) -> Iterator[str]:
    """Yield all files of a package, without importing it."""
    for folder in folders_of(package):
        for entry in _entries(folder):
            yield entry.path


def facts_of(paths: Iterable[str]) -> bytes:
    """Return what changes with any of some files and folders."""
    return _digest(map(_fact, paths))


def _entries(folder: str) -> Iterator[os.DirEntry[str]]:
    """Yield each file in a folder, and in those within it, in one order."""
    with os.scandir(folder) as entries:
        found = sorted(entries, key=lambda entry: entry.name)
    for entry in found:
        if not entry.is_dir():
            yield entry
        elif entry.name != "__pycache__":
            yield from _entries(entry.path)


def _fact(path: str) -> str:
    try:
        return _line(path, os.stat(path))
    except OSError:
        return path


def _line(path: str, facts: os.stat_result) -> str:
    return f"{path} {facts.st_size} {facts.st_mtime_ns}"


def _digest(facts: Iterable[str]) -> bytes:
    return sha256("\n".join(facts).encode("utf-8", "surrogateescape")).digest()
