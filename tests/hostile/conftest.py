"""The command line, as tests/cli calls it."""

from __future__ import annotations

from tests.cli.conftest import app, here, plutoc

__all__ = ["app", "here", "plutoc"]
