"""What the brain's commands write, to whatever they are given to write to."""

from __future__ import annotations

import io
import sys

import pytest

from pluto_fleet.shared import output


def test_a_message_is_on_its_way_as_soon_as_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """What comes next may be the end of the process."""
    there = io.BytesIO()
    monkeypatch.setattr(sys, "stderr", io.TextIOWrapper(there, "utf-8", line_buffering=False))
    output.tell("cf1 does not answer")
    assert there.getvalue() == b"cf1 does not answer\n"
