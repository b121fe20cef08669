"""What may be written outside of the app's braces: the header, packages, the app itself."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from plutoc.graph.names import in_plain_letters, in_snake_case
from plutoc.registry import STD, installed_packages
from plutoc.service.answers import Sort
from plutoc.service.completion.candidate import Candidate
from plutoc.service.completion.declarations import keyword
from plutoc.service.completion.hole import Hole


def outside(hole: Hole, path: str) -> Iterator[Candidate]:
    """Give what may stand before the app, or in its first line."""
    match hole.types:
        case ("USE",):
            for package in installed_packages():
                if package != STD:
                    yield Candidate(label=package, kind=Sort.PACKAGE, detail="installed")
        case ("USE", _):
            yield keyword("as")
        case ("APP",):
            for name in _names(path):
                yield Candidate(label=name, kind=Sort.VALUE, detail="the name of the package")
        case ():
            yield from _beginnings(hole, path)


def _beginnings(hole: Hole, path: str) -> Iterator[Candidate]:
    name = next(_names(path))
    app = f"app {name} {{\n}}\n"
    if "PLUTO" not in hole.above:
        whole = f"pluto 1\n\n{app}" if "APP" not in hole.above else "pluto 1"
        yield keyword("pluto", "pluto 1", "pluto", whole)
    else:
        yield keyword("app", "app", app)
        unused = [package for package in installed_packages() if package != STD]
        yield keyword("use", "use", *(f"use {package}" for package in unused))


def _names(path: str) -> Iterator[str]:
    """Give names for an app: that of its file, that of its folder, any."""
    whole = PurePath(path)
    for part in (whole.stem, whole.parent.name):
        name = in_plain_letters(in_snake_case(part)) if part else None
        if name and name != "app":
            yield name.lower()
    yield "my_app"
