"""The examples, compiled once, each with its own two files."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import pytest

from pluto_fleet.app import described
from tests.flying import NAMES, Example, built

if TYPE_CHECKING:
    from pluto_fleet.app import App


@pytest.fixture(scope="session", params=NAMES)
def example(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Example:
    """Return an example, compiled and imported."""
    return built(request.param, tmp_path_factory.mktemp("examples"))


@pytest.fixture
def example_app(example: Example) -> App:
    """Return its app."""
    app: App = described(import_module(f"{example.name}.flow").APP)
    return app
