"""A watch over forked processes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import partial

import pytest

from tests.forks import recorded
from tests.kill.lives import eventually


@pytest.fixture
def no_worker_left(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Hold that each process that a test forks has ended, and was waited for; others may have children here."""
    forked = recorded(monkeypatch)
    yield
    assert forked, "nothing was forked"
    for child in forked:
        assert eventually(partial(_is_gone, child))  # a thread may be just waiting for it


def _is_gone(child: int) -> bool:
    """Return whether a child has ended and was waited for; it is left for its parent to wait for."""
    try:
        os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    except ChildProcessError:
        return True
    return False
