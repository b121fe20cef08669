"""An example with light drones and lifters, compiled a moment ago."""

from __future__ import annotations

from importlib import import_module

import pytest

from pluto_fleet.app import App, described
from tests.flying import Example, built

NAME = "warehouse_item_finder"


@pytest.fixture(scope="session")
def warehouse(tmp_path_factory: pytest.TempPathFactory) -> tuple[App, Example]:
    """Return the app, and its own missions and fleet."""
    example = built(NAME, tmp_path_factory.mktemp("apps"))
    return described(import_module(f"{NAME}.flow").APP), example
