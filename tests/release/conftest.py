"""The library as users get it: its wheel."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.paths import ROOT
from tests.release.environments import succeed


@pytest.fixture(scope="session")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The library, built once."""
    wheels = tmp_path_factory.mktemp("wheels")
    succeed(sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", wheels, ROOT / "runtime")
    (wheel,) = wheels.iterdir()
    return wheel
