"""The library as users get it, its wheel; and all tests beside this are long: pip builds and installs."""

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


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave them out of the default run, as each waits for pip or for a wheel."""
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.long)
