"""`plutoc`, as a person types it: the sessions in the folder `sessions`."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.cli import main
from tests.kit.session import check_session, sessions


@pytest.mark.parametrize("session", sessions(Path(__file__).parent / "sessions"))
def test_what_is_typed_prints_what_is_written(session: Path, update: bool, tmp_path: Path) -> None:
    """With the exit codes, and the files that come of it."""
    check_session(session, {"plutoc": main}, update, tmp_path)
