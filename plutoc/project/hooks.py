"""Where an app's package goes, and the hooks.py that counts: the package's own, else the one beside."""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from pathlib import Path
from typing import NoReturn

from plutoc.graph.model import Graph
from plutoc.project.reading import UsageError, shown, text_of, why
from plutoc.source import Source

HOOKS = "hooks.py"


def default_folder(file: Path, graph: Graph) -> Path:
    """Return where a package goes if no folder is named."""
    return file.parent / graph.name


def hooks_path(graph: Graph) -> str:
    """Return where in its package an app keeps the developer's code."""
    return f"src/{graph.name}/{HOOKS}"


def find_hooks(graph: Graph, file: Path, folder: Path) -> Source | None:
    """Return the hooks.py that counts: the package's own, else the one beside the app."""
    own = folder / hooks_path(graph)
    for path, top in ((own, folder), (file.parent / HOOKS, file.parent / HOOKS)):
        if _is_there(graph, path):
            _refuse_links(graph, path, top)
            return read_module(path)
    return None


def passed_over(graph: Graph, file: Path, folder: Path) -> Source | None:
    """Return the hooks.py beside the app where the package has one of its own, which counts.

    None where there is no such file. What is no plain text has none here: it is only told of, for
    no command needs it any more, and a link could show any file of the user's.
    """
    own, beside = folder / hooks_path(graph), file.parent / HOOKS
    if not own.is_file() or not beside.is_file() or os.path.samefile(own, beside):
        return None
    if not beside.is_symlink():
        with suppress(UsageError):
            return read_module(beside)
    return Source(shown(beside), "")


def read_module(path: Path) -> Source:
    """Read a module of the developer's, with the line ends that Python sees."""
    text = text_of(path).removeprefix("\ufeff")
    return Source(shown(path), text.replace("\r\n", "\n").replace("\r", "\n"))


def _is_there(graph: Graph, path: Path) -> bool:
    """Return whether there is a file, or a link; refuse what is neither, and has its name.

    A pipe is not opened: it may never be written to.
    """
    try:
        mode = os.lstat(path).st_mode
    except (FileNotFoundError, NotADirectoryError):
        return False
    except (
        OSError,
        ValueError,
    ) as error:  # a name that is too long, a folder that may not be entered
        raise UsageError(f"{shown(path)} cannot be read: {why(error)}") from None
    if not (stat.S_ISREG(mode) or stat.S_ISLNK(mode)):
        is_folder = stat.S_ISDIR(mode)
        _refuse(graph, path, "a folder" if is_folder else "a pipe, a socket or a device", "a file")
    return True


def _refuse_links(graph: Graph, path: Path, top: Path) -> None:
    """Follow no link: a stranger's folder could show, or take along, any file of the user's."""
    for one in reversed((path, *path.parents)):
        if one.is_relative_to(top) and one.is_symlink():
            _refuse(graph, one, "a symbolic link", "a file" if one == path else "a folder")


def _refuse(graph: Graph, path: Path, what: str, wanted: str) -> NoReturn:
    from plutoc.emit.errors import in_the_way, place_of
    from plutoc.emit.write import Refused

    raise Refused([in_the_way(place_of(graph), shown(path), what, wanted)])
