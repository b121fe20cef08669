"""What it costs to watch a flight can be measured."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from tests.kit.browser import chromium
from tests.release.environments import ROOT


@pytest.mark.long  # twenty seconds of a flight, once more
def test_what_it_costs_to_watch_is_measured() -> None:
    chromium()
    few = ["--drones", "2", "--missions", "3", "--tabs", "1", "--seconds", "1", "--json"]
    done = subprocess.run(
        [sys.executable, str(ROOT / "benchmarks" / "station.py"), *few],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["updates a second, least"] > 0
    assert told["versions that it is behind when it reads again"] == 0
    assert all(number >= 0 for number in told.values())
