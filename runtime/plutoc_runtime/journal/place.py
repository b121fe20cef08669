"""Where a journal is, and what lies beside it."""

from __future__ import annotations

from pathlib import Path


def beside(path: Path, suffix: str) -> Path:
    """Return the path of a file or folder that goes with a journal: `.lock`, `.gateway`."""
    return path.with_name(path.name + suffix)


def gateway_folder(path: Path) -> Path:
    """Return where the gateway of this journal keeps its things."""
    return beside(path, ".gateway")
