"""A few random apps whose hooks write wherever they can."""

from __future__ import annotations

import pytest

from tests.hooks.__main__ import one_app


@pytest.mark.parametrize("number", [*range(5), 61])  # 61: all drones are low at once
def test_nothing_stops_but_the_missions_of_such_hooks(number: int) -> None:
    assert one_app(number) == []
