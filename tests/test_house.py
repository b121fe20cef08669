"""The house is in order: types, style, format, and who imports whom."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.paths import ROOT

TOOLS = Path(sys.executable).parent


pytestmark = pytest.mark.first


@pytest.mark.parametrize(
    "command",
    [
        ("ruff", "check", "."),
        ("ruff", "check", "--isolated", "runtime"),  # as in a package that carries it
        ("black", "--check", "--quiet", "."),
        ("lint-imports",),
    ],
    ids=" ".join,
)
def test_a_tool_has_nothing_to_say(command: tuple[str, ...]) -> None:
    has_nothing_to_say(*command)


def test_mypy_has_nothing_to_say() -> None:
    """One after the other, wherever tests run: the second knows what the first has found out."""
    has_nothing_to_say("mypy")
    has_nothing_to_say("mypy", "tests", "benchmarks")


def has_nothing_to_say(tool: str, *arguments: str) -> None:
    """Run a tool of these tests' environment on the house."""
    done = subprocess.run(
        [TOOLS / tool, *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
