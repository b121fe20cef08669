"""The station is light: it opens at once, and what it costs to watch a flight can be measured."""

from __future__ import annotations

import gzip
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.release.environments import ROOT
from tests.station.browser.chrome import chromium

PAGES = ROOT / "runtime" / "pluto_fleet" / "station" / "pages"
MOST = 64_000


def served() -> list[Path]:
    """Return the files that browsers are sent."""
    unserved = (".py", ".ts")
    return [one for one in sorted(PAGES.iterdir()) if one.is_file() and one.suffix not in unserved]


def test_all_pages_together_are_less_than_64_kilobytes_gzipped() -> None:
    """Each by itself, as it lies in the package: nothing is packed together for the browser."""
    weights = {path.name: len(gzip.compress(path.read_bytes(), mtime=0)) for path in served()}
    assert "index.html" in weights
    assert sum(weights.values()) < MOST, weights


def test_no_page_names_another_machine() -> None:
    """Neither a script, nor a style, nor a picture; a namespace is a name and no address."""
    for path in served():
        named = set(re.findall(r"(?:https?:)?//[a-z0-9.-]+\.[a-z]+", path.read_text("utf-8")))
        assert named <= {"http://www.w3.org"}, path.name


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
