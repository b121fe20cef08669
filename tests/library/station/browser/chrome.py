"""Debian's Chromium: where it is, and how it is started so that it asks no server for anything."""

from __future__ import annotations

import os
import shutil

import pytest

NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
"""The first one draws the same for a third less of the CPU: it has no windows."""

ARGUMENTS = [
    "--no-sandbox",  # tests may run as root
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def chromium() -> str:
    """Return the browser's path; without one the test is skipped, and in CI it fails."""
    for name in NAMES:
        path = shutil.which(name)
        if path is not None:
            return path
    why = f"none of {', '.join(NAMES)} is on the path: apt install chromium"
    if os.environ.get("CI"):
        pytest.fail(why)
    pytest.skip(why)
