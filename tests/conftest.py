"""What all tests share."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, settings

# The same examples in every run, however busy the machine is: a test that fails is a change's fault.
settings.register_profile(
    "pluto", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("pluto")


def pytest_addoption(parser: pytest.Parser) -> None:
    """`pytest --update` writes what comes out as what must come out."""
    parser.addoption(
        "--update", action="store_true", help="rewrite the expected output of tests/cases"
    )


@pytest.fixture
def update(request: pytest.FixtureRequest) -> bool:
    """Whether expected output is to be rewritten."""
    return bool(request.config.getoption("--update"))
