"""Plants one bug in a copy of the checkout, and runs the tests that reach it until one fails."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.paths import ROOT
from tests.planted.bug import Bug
from tests.planted.reach import Reach

FIRST = 40
"""So many tests are tried at first: to look for the others takes longer than to run these."""
_TIMES = 6.0
"""How much longer than measured tests may take before they count as never ending: a busy machine is no catch."""
_PATHS = (".", "grammar", "runtime", "stdlib_blocks")


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What came of a bug."""

    bug: Bug
    line: int
    reached: int
    """How many tests reach it."""
    catcher: str | None
    """The first test that fails."""
    seconds: float

    @property
    def place(self) -> str:
        """Where it was planted."""
        return f"{self.bug.file}:{self.line}"


class Copy:
    """A copy of the checkout, in which one bug at a time is planted."""

    def __init__(self, folder: Path, reach: Reach, limit: float) -> None:
        self._folder = folder
        self._reach = reach
        self._limit = limit
        listed = ["git", "ls-files", "-co", "--exclude-standard"]
        names = subprocess.run(listed, cwd=ROOT, capture_output=True, check=True, text=True)
        for name in names.stdout.splitlines():
            if (ROOT / name).is_file():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, folder / name)
        self._changed = time.time()
        self._fit: dict[str, bool] = {}
        """Whether a test that has failed passes in this copy when no bug is in it."""

    def try_out(self, bug: Bug) -> Verdict:
        """Plant a bug, look who catches it, and take it back."""
        file = self._folder / bug.file
        text = (ROOT / bug.file).read_text(encoding="utf-8")
        tests = self._reach.tests(bug, text)
        began = time.monotonic()
        catcher = None
        for some in _parts(tests):
            catcher = self._catcher(some, file, text, bug.planted(text))
            if catcher is not None:
                break
        seconds = time.monotonic() - began
        return Verdict(
            bug=bug, line=bug.line(text), reached=len(tests), catcher=catcher, seconds=seconds
        )

    def _catcher(self, tests: Sequence[str], file: Path, sound: str, planted: str) -> str | None:
        """Return the first test that fails with a bug and passes without it."""
        while left := [test for test in tests if self._fit.get(test, True)]:
            self._write(file, planted)
            try:
                failure = self._first_failure(left)
            finally:
                self._write(file, sound)
            if failure not in left:  # none, or the whole run
                return failure
            if failure not in self._fit:
                self._fit[failure] = self._first_failure([failure]) is None
            if self._fit[failure]:
                return failure
        return None

    def _write(self, file: Path, text: str) -> None:
        """Write a file so that what was compiled of it before is out of date: that is looked up by the second."""
        file.write_text(text, encoding="utf-8")
        self._changed += 2
        os.utime(file, (self._changed, self._changed))

    def _first_failure(self, tests: Sequence[str]) -> str | None:
        listed = self._folder / "tests.txt"
        listed.write_text("\n".join(tests), encoding="utf-8")
        command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "--tb=no", "-rfE"]
        command += ["-p", "no:cacheprovider", f"--basetemp={self._folder / 'tmp'}", f"@{listed}"]
        paths = os.pathsep.join(str(self._folder / path) for path in _PATHS)
        environment = {**os.environ, "PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": ""}
        with subprocess.Popen(
            command,
            cwd=self._folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        ) as run:
            try:
                said, _ = run.communicate(timeout=self._longest(tests))
            except subprocess.TimeoutExpired:
                os.killpg(run.pid, 9)
                return "one that then never ends"
        if run.returncode == 0:
            return None
        found = re.search(r"^(?:FAILED|ERROR) (.+)$", said, re.MULTILINE)
        if found is None:
            return f"the run itself: {said.strip()[-200:]}"
        # a name may have blanks, and a reason stands behind it
        named = [test for test in tests if found[1].startswith(test)]
        return max(named, key=len, default=found[1])

    def _longest(self, tests: Sequence[str]) -> float:
        return max(self._limit, _TIMES * sum(self._reach.seconds[test] for test in tests))


def _parts(tests: Sequence[str]) -> Iterator[Sequence[str]]:
    if tests:
        yield tests[:FIRST]
    if len(tests) > FIRST:
        yield tests[FIRST:]
