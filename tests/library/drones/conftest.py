"""Async tests of drones take no time: their loop's clock jumps."""

from __future__ import annotations

import pytest

from tests.kit.drones import run
from tests.loops import run_async


def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    return run_async(pyfuncitem, run)
