"""A package is thin: what is in it can be read in an afternoon, and touches nothing outside."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache

import pytest

from plutoc.compile import compile_source
from plutoc.source import Source
from tests.paths import EXAMPLES

NAMES = sorted(path.name for path in EXAMPLES.iterdir())
SMALLEST = "drugs_distribution"
MOST_LINES, MOST_FILES, MOST_OWN_LINES = 7_130, 66, 250
"""Of the package of the thesis's basic flow: all of its Python, its tests included; and without the brain."""
MOST_LINES_OF_ANY = 8_990
LONGEST_FILE = 300

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
    assert sum(lengths(name).values()) <= MOST_LINES_OF_ANY
    assert max(lengths(name).values()) <= LONGEST_FILE


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


ONLY_WITH = {
    "flow.judgement": "MissionEvaluator",
    "flow.modification": "MissionModifier",
}
"""Modules of the runtime that a kind of block alone needs."""
OF_HOOKS = {"hooks.calls", "hooks.context", "alone.testing", "time.virtual"}
"""What calls the app's own code, and what that is given."""
OF_STRANGERS = ("flow.declared",)
"""What holds blocks of other packages to what they declare: no example has one."""


@pytest.mark.parametrize("example", NAMES)
def test_modules_that_nothing_needs_stay_behind(example: str) -> None:
    """A module that some app carries is carried by those that need it, and by no other."""
    text = (EXAMPLES / example / "app.pluto").read_text(encoding="utf-8")
    carried = carried_by(example)
    for module, kind in ONLY_WITH.items():
        assert (module in carried) == (kind in text)
    hooks = set(re.findall(r"^ *(action|evaluator|modifier|policy) ", text, re.MULTILINE))
    assert carried & OF_HOOKS == (OF_HOOKS if hooks else set())
    assert ("flow.asking" in carried) == bool(hooks - {"policy"})
    assert not carried & set(OF_STRANGERS)
    chosen = re.search(r"policy: (\w+)", text)
    assert carried & POLICIES == NEEDED.get(chosen[1] if chosen else "least_makespan", OWN)


NEEDED = {
    "batch_optimal": {"fleet.assignment", "fleet.batch", "fleet.batch_optimal"},
    "earliest_deadline": {"fleet.batch", "fleet.durations", "fleet.earliest_deadline"},
    "least_makespan": {"fleet.batch", "fleet.durations", "fleet.least_makespan"},
    **{name: set[str]() for name in ("first", "least_used", "nearest")},
}
"""The modules of each policy of ours, beside `fleet.policies`."""
OWN = {"fleet.batch", "fleet.own_batch", "fleet.own_policy"}
"""That of a policy that is a hook of the app's own."""
POLICIES = OWN.union(*NEEDED.values())


def carried_by(name: str) -> set[str]:
    """Return the modules of the runtime that an app carries, its blocks' steps aside."""
    paths = [path.partition("/_runtime/")[2] for path in package(name)]
    names = {path.removesuffix(".py").replace("/", ".") for path in paths if path.endswith(".py")}
    return {name for name in names if not name.startswith("blocks.") and "__init__" not in name}
