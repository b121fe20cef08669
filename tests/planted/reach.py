"""Which tests of the default run reach a line, and how long each takes: measured once for a state of the product."""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import pytest
from coverage import CoverageData

from tests.paths import ROOT
from tests.planted.bug import Bug

KEPT = ROOT / ".planted"
"""Not part of the project: what was measured."""
PRODUCT = {
    "plutoc": "plutoc",
    "runtime/plutoc_runtime": "plutoc_runtime",
    "runtime/pluto_fleet": "pluto_fleet",
    "stdlib_blocks/plutoc_blocks": "plutoc_blocks",
}
_MIRRORED = {
    "plutoc": "tests/compiler",
    "runtime/plutoc_runtime": "tests/brain",
    "runtime/pluto_fleet": "tests/library",
    "stdlib_blocks/plutoc_blocks": "tests/brain/blocks",
}
"""The rooms of tests mirror those of the product."""


class Stopwatch:
    """Records how long each test takes, and which pass."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self.failed: list[str] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Add a phase of a test."""
        self.seconds[report.nodeid] = self.seconds.get(report.nodeid, 0.0) + report.duration
        if report.failed:
            self.failed.append(report.nodeid)


@dataclass(frozen=True)
class Reach:
    """What was measured."""

    data: CoverageData
    seconds: Mapping[str, float]
    root: Path = field(default=ROOT)

    def tests(self, bug: Bug, text: str) -> list[str]:
        """Return the tests that reach a bug: those beside its file first, quick ones before slow."""
        by_line = self.data.contexts_by_lineno(str(self.root / bug.file))
        first = bug.line(text)
        # a statement of several lines is counted at its first
        at = max((line for line in by_line if line <= first), default=first)
        lines = {at, *range(first, first + bug.before.count("\n") + 1)}
        found = {test for line in lines for test in self._of(by_line.get(line, ()))}
        if not found:  # it is read when the module is imported
            found = {test for contexts in by_line.values() for test in self._of(contexts)}
        if not found:  # nothing but definitions is in it
            found = set(self.seconds)
        return sorted(found, key=lambda test: (distance(bug.file, test), self.seconds[test]))

    def _of(self, contexts: Sequence[str]) -> list[str]:
        names = (context.partition("|")[0] for context in contexts)
        return [name for name in names if name in self.seconds]

    @cached_property
    def total(self) -> float:
        """Seconds of all tests, one after the other."""
        return sum(self.seconds.values())


def distance(file: str, test: str) -> int:
    """Return how far a test is from a file: 0 in its own room, 1 in its part of the house, 2 elsewhere, 3 in no room."""
    for place, room in _MIRRORED.items():
        if file.startswith(f"{place}/"):
            inner = file.removeprefix(f"{place}/").split("/")[0]
            if test.startswith(f"{room}/{inner}/") or room.endswith("blocks"):
                return 0
            if test.startswith(f"{room}/"):
                return 1
    return 2 if test.startswith(("tests/compiler/", "tests/brain/", "tests/library/")) else 3


def state() -> str:
    """Return a name of the state of product and tests."""
    names = ["-co", "--exclude-standard", "--", *PRODUCT, "tests", "examples", "pyproject.toml"]
    listed = subprocess.run(["git", "ls-files", *names], cwd=ROOT, capture_output=True, check=True)
    digest = hashlib.sha256()
    for name in sorted(listed.stdout.decode().splitlines()):
        path = ROOT / name
        if path.suffix == ".py" and path.is_file():
            digest.update(name.encode() + path.read_bytes())
    return digest.hexdigest()


def measured(anew: bool) -> Reach:
    """Return which tests reach what; measure it, in some ten minutes, if that is not known of this state."""
    about = KEPT / "seconds.json"
    known = json.loads(about.read_text()) if about.exists() and not anew else {}
    if known.get("state") != state():
        known = {"state": state(), "seconds": _measure()}
        about.write_text(json.dumps(known))
    data = CoverageData(str(KEPT / "coverage"))
    data.read()
    return Reach(data=data, seconds=known["seconds"])


def _measure() -> Mapping[str, float]:
    print("measuring which tests reach which lines …", file=sys.stderr, flush=True)
    KEPT.mkdir(exist_ok=True)
    settings = KEPT / "settings.ini"
    settings.write_text(f"[run]\nparallel = true\ndata_file = {KEPT / 'coverage'}\n")
    watch = Stopwatch()
    sources = [f"--cov={name}" for name in PRODUCT.values()]
    how = ["-q", "-n", "2", "--dist", "worksteal", "--cov-context=test", "--cov-report="]
    pytest.main([*how, f"--cov-config={settings}", *sources], plugins=[watch])
    if watch.failed:
        print(f"{len(watch.failed)} tests fail without any bug: {watch.failed[:5]}")
    return {test: spent for test, spent in watch.seconds.items() if test not in watch.failed}
