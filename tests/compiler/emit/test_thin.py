"""A package is thin: what is in it can be read in an afternoon, and touches nothing outside."""

from __future__ import annotations

import ast

import pytest

from plutoc.compile import compile_source
from plutoc.source import Source
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
NAMES = sorted(path.name for path in EXAMPLES.iterdir())
SMALLEST = "drugs_distribution"
MOST_LINES, MOST_FILES = 7_130, 66
"""Of the package of the thesis's basic flow: all of its Python, its tests included."""
MOST_LINES_OF_ANY = 8_990
LONGEST_FILE = 300

OUTSIDE = {"asyncio", "ctypes", "multiprocessing", "socket", "sqlite3", "ssl", "subprocess"}
OUTSIDE |= {"select", "selectors", "signal", "threading", "urllib", "http", "webbrowser"}
"""What nothing embedded may import: it would touch what only the library touches."""
SYSTEM = {"os", "time"}
"""What nothing embedded may import but these two files."""
USE_THE_SYSTEM = ("/_runtime/command.py", "/_runtime/alone/files.py")


def package(name: str) -> dict[str, str]:
    """Return the files of an example's package."""
    text = (EXAMPLES / name / "app.pluto").read_text(encoding="utf-8")
    made = compile_source(
        Source("app.pluto", text), source_name="app.pluto", find_hooks=lambda _: None
    ).package
    return {**made.owned, **made.once}


def lines(files: dict[str, str]) -> int:
    """Return how many lines of Python these are."""
    return sum(len(text.splitlines()) for path, text in files.items() if path.endswith(".py"))


def test_every_package_is_thin(capsys: pytest.CaptureFixture[str]) -> None:
    sizes = {name: package(name) for name in NAMES}
    with capsys.disabled():
        print()
        for name, files in sizes.items():
            print(f"  {name:28}{lines(files):6} lines of Python{len(files):4} files")
    assert lines(sizes[SMALLEST]) <= MOST_LINES
    assert len(sizes[SMALLEST]) <= MOST_FILES
    assert max(map(lines, sizes.values())) <= MOST_LINES_OF_ANY
    long = {
        path: len(text.splitlines())
        for files in sizes.values()
        for path, text in files.items()
        if path.endswith(".py") and len(text.splitlines()) > LONGEST_FILE
    }
    assert long == {}


@pytest.mark.parametrize("name", NAMES)
def test_nothing_embedded_touches_what_is_outside(name: str) -> None:
    files = {path: text for path, text in package(name).items() if "/_runtime/" in path}
    assert all(path.endswith(".py") for path in files)
    imported = {
        (path, module)
        for path, text in files.items()
        for node in ast.walk(ast.parse(text))
        for module in _modules(node)
        if module.partition(".")[0]
        in (OUTSIDE if path.endswith(USE_THE_SYSTEM) else OUTSIDE | SYSTEM)
    }
    assert imported == set()


def _modules(node: ast.AST) -> list[str]:
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom) and not node.level:
        return [node.module or ""]
    return []
