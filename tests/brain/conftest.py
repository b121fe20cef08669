"""What tests of the brain share: the examples."""

from __future__ import annotations

import pytest

from tests.kit import apps


@pytest.fixture(params=apps.NAMES)
def example(request: pytest.FixtureRequest) -> apps.Example:
    """Return an example, compiled and imported."""
    return apps.example(request.param)
