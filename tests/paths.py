"""Where the tests find what they test."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).parents[1]
"""The checkout."""
EXAMPLES = ROOT / "examples"
CASES = ROOT / "tests" / "cases"
