"""The default run is one that people wait for: few of its tests need a browser, or a process of their own."""

from __future__ import annotations

import pytest

MOST = {"browser": 25, "process": 40}


@pytest.mark.parametrize("kind", MOST)
def test_the_default_run_has_few_of_the_slow_kinds(
    kind: str, request: pytest.FixtureRequest
) -> None:
    items = [item for item in request.session.items if item.get_closest_marker("long") is None]
    assert sum(item.get_closest_marker(kind) is not None for item in items) <= MOST[kind]
