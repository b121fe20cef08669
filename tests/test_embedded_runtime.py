"""The runtime is the same in its second home: its tests pass on an embedded copy."""

from __future__ import annotations

import os
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import plutoc_runtime
from plutoc.emit.embed import Carried, embed
from plutoc.registry import STD
from plutoc_blocks import BLOCKS
from tests.paths import ROOT

# the tests of the runtime once more; the packages' own tests run on a copy, too
pytestmark = [pytest.mark.long, pytest.mark.first]


def test_the_runtimes_tests_pass_on_an_embedded_copy(tmp_path: Path) -> None:
    package = tmp_path / "carrier"
    steps = [Carried(package=STD, function=block.step) for block in BLOCKS]
    modules = [
        module.name
        for module in pkgutil.walk_packages(plutoc_runtime.__path__, "plutoc_runtime.")
        if not module.ispkg
    ]
    package.mkdir()
    (package / "__init__.py").touch()
    for path, text in embed(steps, modules).items():
        file = package / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    tests = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/brain"]
    # commands and files are the library's, and read the same with any copy; two take a minute
    others = ("test_workers.py", "policies/test_ageing.py")
    tests += [f"--ignore=tests/brain/{name}" for name in others]
    environment = {**os.environ, "PLUTO_EMBEDDED": str(tmp_path)}
    done = subprocess.run(
        tests, cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    assert " passed" in done.stdout
