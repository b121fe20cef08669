"""What the tests of the command line remember helps here too."""

from __future__ import annotations

from tests.cli.conftest import formatted_once

__all__ = ["formatted_once"]
