"""An app in a folder of its own, as tests/compiler/cli has it."""

from __future__ import annotations

from tests.compiler.cli.conftest import app, here

__all__ = ["app", "here"]
