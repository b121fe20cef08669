"""Each example is compiled once for all tests."""

from __future__ import annotations

import pytest

from tests.flying import NAMES, Example, built


@pytest.fixture(scope="session", params=NAMES)
def example(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Example:
    """Return an example, compiled and imported."""
    return built(request.param, tmp_path_factory.mktemp("examples"))
