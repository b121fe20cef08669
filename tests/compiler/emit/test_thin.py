"""A package is thin: what is in it can be read in an afternoon, and touches nothing outside."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache

import pytest

from plutoc.compile import compile_source
from plutoc.source import Source
from tests.paths import EXAMPLES

NAMES = sorted(path.name for path in EXAMPLES.iterdir())
SMALLEST = "drugs_distribution"
MOST_LINES = 8_760
MOST_FILES = 65
MOST_OWN_LINES = 250
"""Of the package of the thesis's basic flow: all of its Python, its tests included, with 3 % of room; and without the brain."""
MOST_LINES_WITHOUT_EVENTS = 10_780
MOST_LINES_OF_ANY = 13_000
REACT = ("aerial_mapping", "pursue")
"""The examples with events, or with actions on the way."""

OUTSIDE = {"asyncio", "ctypes", "multiprocessing", "socket", "sqlite3", "ssl", "subprocess"}
OUTSIDE |= {"select", "selectors", "signal", "threading", "urllib", "http", "webbrowser"}
"""What nothing embedded may import: it would touch what only the library touches."""
SYSTEM = {"os", "time"}
"""What nothing embedded may import but these two files."""
USE_THE_SYSTEM = ("/_runtime/command.py", "/_runtime/alone/files.py")


@cache
def package(name: str) -> dict[str, str]:
    """Return the files of an example's package."""
    text = (EXAMPLES / name / "app.pluto").read_text(encoding="utf-8")
    made = compile_source(
        Source("app.pluto", text), source_name="app.pluto", find_hooks=lambda _: None
    ).package
    return {**made.owned, **made.once}


def lengths(name: str) -> dict[str, int]:
    """Return how many lines each module has."""
    files = package(name).items()
    return {path: len(text.splitlines()) for path, text in files if path.endswith(".py")}


def test_the_package_of_the_basic_flow_is_thin() -> None:
    own = {path: n for path, n in lengths(SMALLEST).items() if "/_runtime/" not in path}
    assert sum(lengths(SMALLEST).values()) <= MOST_LINES
    assert sum(own.values()) <= MOST_OWN_LINES, own
    assert len(package(SMALLEST)) <= MOST_FILES


@pytest.mark.parametrize("name", NAMES)
def test_every_package_is_thin(name: str) -> None:
    reacts = any("/_runtime/events/" in path for path in package(name))
    assert reacts is (name in REACT)
    most = MOST_LINES_OF_ANY if reacts else MOST_LINES_WITHOUT_EVENTS
    assert sum(lengths(name).values()) <= most


def test_nothing_embedded_touches_what_is_outside() -> None:
    """In the packages of all examples."""
    embedded = {p: text for n in NAMES for p, text in package(n).items() if "/_runtime/" in p}
    once = {path.partition("/_runtime/")[2]: (path, text) for path, text in embedded.items()}
    for path, text in once.values():
        forbidden = OUTSIDE if path.endswith(USE_THE_SYSTEM) else OUTSIDE | SYSTEM
        assert path.endswith(".py")
        assert not forbidden & set(_imported(text)), path


def _imported(text: str) -> Iterator[str]:
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield (node.module or "").partition(".")[0]
