"""The files beside those that an editor has open."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from plutoc.graph.model import Graph
from plutoc.project.hooks import HOOKS, default_folder, find_hooks, hooks_path
from plutoc.project.reading import UsageError, shown, text_of
from plutoc.source import Source

_MOST_APPS = 20
"""Of a folder: to find the app that a hooks.py belongs to, no more are read."""


def read_app(path: Path) -> str | None:
    """Return the text of an app's file; None where it cannot be read."""
    try:
        return text_of(path)
    except UsageError:
        return None


def hooks_places(graph: Graph, app: Path) -> tuple[Path, ...]:
    """Return where the hooks.py of an app can be: the first that is there counts."""
    return default_folder(app, graph) / hooks_path(graph), app.parent / HOOKS


def read_hooks(graph: Graph, app: Path) -> tuple[Path, Source] | None:
    """Return the hooks.py that counts, if there is one."""
    try:
        found = find_hooks(graph, app, default_folder(app, graph))
    except UsageError:  # no text: there is nothing in it to show a mistake at
        return None
    if found is None:
        return None
    places = hooks_places(graph, app)
    return next((place, found) for place in places if shown(place) == found.path)


def apps_beside(hooks: Path) -> Iterator[Path]:
    """Give the files of apps whose hooks.py this may be: beside it, or beside its package."""
    for folder in dict.fromkeys((hooks.parent, *hooks.parents[3:4])):
        yield from sorted(folder.glob("*.pluto"))[:_MOST_APPS]
