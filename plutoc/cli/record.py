"""What a compile has left, kept for the next time: see `unchanged.py`."""

from __future__ import annotations

import os
import re
import stat
import sys
from collections.abc import Iterable
from pathlib import Path

from plutoc.cli import unchanged
from plutoc.cli.compiler import OURS
from plutoc.cli.files import HOOKS, hooks_path, shown
from plutoc.cli.options import Options
from plutoc.compile import Compiled
from plutoc.emit.write import Changes
from plutoc.installed import files_of
from plutoc.source import Source

_CLOCK = 50_000_000
"""In ns: by how much the times of files may lag behind the clock."""
_USE = re.compile(r"^\s*use\b", re.MULTILINE)


def record(
    options: Options,
    begun: int,
    compiled: Compiled,
    changes: Changes,
    beside: Source | None,
    words: unchanged.Words,
) -> None:
    """Remember a compile after which the folder is as it shall be; `words` are those of the next.

    What was found in a hooks.py beside the app would be told of its copy next time, and that the two
    differ: this is not remembered, but compiled once more. So is what was compiled while blocks
    were being written: they may have been read before. `begun` is when it began, in ns of the epoch;
    `beside` is the hooks.py beside the app, where it was passed over.
    """
    package, path = compiled.package, hooks_path(compiled.checked)
    own = os.fspath(changes.folder / path)
    hooks = compiled.hooks
    if hooks is not None and hooks.path != shown(Path(own)):
        return
    source = compiled.checked.graph.source
    others = _others(compiled) if _USE.search(source.text) else []
    if _any_since(begun - _CLOCK, others):
        return
    unchanged.remember(
        options.arguments,
        app=(os.fspath(options.file), source.text),
        hooks=(own, package.once[path] if hooks is None else hooks.text),
        beside=(os.fspath(options.file.parent / HOOKS), beside.text if beside else None),
        folder=os.fspath(changes.folder),
        written=package.owned,
        there=package.once,
        others=others,
        words=words,
    )


def _others(compiled: Compiled) -> list[str]:
    """Return the files on which other people's blocks hang, and the folders to install others in.

    That is whatever was loaded, and the whole package that a block comes from.
    """
    steps = [node.block.step.__module__.partition(".")[0] for node in compiled.checked.graph.nodes]
    packages = [name for name in dict.fromkeys(steps) if name not in OURS]
    loaded = [getattr(module, "__file__", None) for module in list(sys.modules.values())]
    return [
        *dict.fromkeys(path or os.curdir for path in sys.path),
        *(path for path in loaded if isinstance(path, str)),
        *(path for name in packages for path in files_of(name)),
    ]


def _any_since(time: int, paths: Iterable[str]) -> bool:
    """Say whether a file was written since; a folder may have been, by what Python keeps in it."""
    for path in paths:
        try:
            facts = os.stat(path)
        except OSError:
            continue
        if stat.S_ISREG(facts.st_mode) and facts.st_mtime_ns > time:
            return True
    return False
