"""Which children a test forks: its worker may have others, left by other tests."""

from __future__ import annotations

import os

import pytest


def recorded(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return a list to which every child is added that this process forks from now on."""
    forked: list[int] = []
    fork = os.fork

    def forks() -> int:
        child = fork()
        forked.append(child)
        return child

    monkeypatch.setattr(os, "fork", forks)
    return forked
