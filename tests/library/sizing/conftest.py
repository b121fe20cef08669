"""Runs are flown in this process: that workers find the same is one test's matter."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

import pytest

from pluto_fleet.sizing import tries

T = TypeVar("T")
R = TypeVar("R")


def here(work: Callable[[T], R], tasks: Sequence[T], jobs: int, *, quiet: bool) -> Iterator[R]:
    """Do the tasks one after the other."""
    return map(work, tasks)


@pytest.fixture(autouse=True)
def no_workers(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fork no worker, unless the test says that it starts processes."""
    if request.node.get_closest_marker("process") is None:
        monkeypatch.setattr(tries, "in_workers", here)
