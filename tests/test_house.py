"""The house is in order: types, style, format, and who imports whom."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
TOOLS = Path(sys.executable).parent


@pytest.mark.parametrize(
    "command",
    [
        ("mypy",),
        ("mypy", "tests", "benchmarks"),
        ("ruff", "check", "."),
        ("ruff", "check", "--isolated", "runtime"),  # as in a package that carries it
        ("black", "--check", "--quiet", "."),
        ("lint-imports",),
    ],
    ids=" ".join,
)
def test_a_tool_has_nothing_to_say(command: tuple[str, ...]) -> None:
    tool, *arguments = command
    done = subprocess.run(
        [TOOLS / tool, *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
