"""Which copy of the runtime these tests run on."""

from __future__ import annotations

import os

from pluto_fleet.shared.time.future import Future
from plutoc_blocks.clock.step import wait_for_time


def test_these_tests_run_on_the_copy_that_is_meant() -> None:
    embedded = "PLUTO_EMBEDDED" in os.environ
    home = "carrier._runtime" if embedded else "plutoc_runtime"
    assert Future.__module__ == f"{home}.time.future"
    block = f"{home}.blocks.clock" if embedded else "plutoc_blocks.clock.step"
    assert wait_for_time.__module__ == block
