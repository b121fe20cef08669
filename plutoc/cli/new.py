"""`new`: a folder with a small app, or with one of the examples, to begin with."""

from __future__ import annotations

import os
from importlib.resources import files
from pathlib import Path

from plutoc.cli.endings import CLEAN, UsageError
from plutoc.cli.options import Options
from plutoc.diagnostic import Diagnostic
from plutoc.emit.write import CannotWrite, create
from plutoc.graph.scope import check_app_name
from plutoc.source import Source, Span
from plutoc.syntax.tree import Name
from plutoc_runtime import output
from plutoc_runtime.domain.text import printable

_IN_STARTER = "my_app"
"""The app's name in the files of the starter."""


def new(options: Options) -> int:
    """Write a first app into a folder of its own, and say how to go on."""
    name = options.name
    _check_name(name)
    texts, what = _first_app(name, options.example)
    folder = Path(name)
    if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
        raise UsageError(f"{name} is there already, and is no folder: choose another name")
    try:
        if folder.exists() and os.listdir(folder):
            raise UsageError(f"the folder {name} is not empty: choose another name")
        create(folder, texts)
    except CannotWrite as error:
        raise UsageError(f"{printable(str(error))}; nothing was changed") from None
    output.line(
        f"{name}/ is ready: {what}.\n\n"
        f"  cd {name}\n"
        f"  plutoc check {name}.pluto    # is the app sound?\n"
        f"  plutoc run {name}.pluto      # fly the missions, simulated\n"
        f"  plutoc compile {name}.pluto  # write it as a Python package"
    )
    return CLEAN


def _check_name(name: str) -> None:
    if not name:
        raise UsageError("an app needs a name\nhelp: choose a plain name, such as crop_watch")
    found: list[Diagnostic] = []
    span = Span(0, len(name))
    check_app_name(Source("NAME", name), Name(text=name, span=span), found)
    if found:
        first = found[0]
        raise UsageError(first.message + (f"\nhelp: {first.help}" if first.help else ""))


def _first_app(name: str, example: str | None) -> tuple[dict[str, str], str]:
    """Return the files, and what they are in words."""
    if example is None:
        return _starter(name), "an app, its missions and a fleet"
    from plutoc.cli.examples import copied, has_hooks, title

    texts = copied(example, name)
    own = (
        "its missions, a fleet and its hooks" if has_hooks(example) else "its missions and a fleet"
    )
    return texts, f"{title(example)}, {own}"


def _starter(name: str) -> dict[str, str]:
    folder = files("plutoc.cli").joinpath("starter")
    names = {"app.pluto": f"{name}.pluto", "missions.toml": "missions.toml"}
    names["fleet.toml"] = "fleet.toml"
    return {
        path: folder.joinpath(file).read_text(encoding="utf-8").replace(_IN_STARTER, name)
        for file, path in names.items()
    }
