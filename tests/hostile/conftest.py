"""The command line, as tests/compiler/cli calls it."""

from __future__ import annotations

from tests.compiler.cli.conftest import app, here, plutoc

__all__ = ["app", "here", "plutoc"]
