"""An example with light drones and lifters, compiled a moment ago."""

from __future__ import annotations

import pytest

from pluto_fleet.app import App
from tests.kit.apps import Example, example

NAME = "warehouse_item_finder"


@pytest.fixture(scope="session")
def warehouse() -> tuple[App, Example]:
    """Return the app, and its own missions and fleet."""
    warehouse = example(NAME)
    return warehouse.app, warehouse
