"""A watch over forked processes."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from tests.forks import recorded


@pytest.fixture
def no_worker_left(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Hold that each process that a test forks has ended, and was waited for; others may have children here."""
    forked = recorded(monkeypatch)
    yield
    assert forked, "nothing was forked"
    for child in forked:
        with pytest.raises(ChildProcessError):
            os.waitpid(child, os.WNOHANG)
