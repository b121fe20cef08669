"""The user's own cache folder. What is in it gets run: nobody else may be able to write there."""

from __future__ import annotations

import os
import stat
from pathlib import Path


def cache_folder() -> Path | None:
    """Return the folder, or None where it would not be safe or cannot be written."""
    try:
        root = os.environ.get("XDG_CACHE_HOME", "")
        base = Path(root) if os.path.isabs(root) else Path.home() / ".cache"
        folder = base / "pluto"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        return folder if _is_ours(folder) else None
    except (OSError, RuntimeError):  # RuntimeError: there is no home folder
        return None


def _is_ours(folder: Path) -> bool:
    facts = folder.lstat()
    if not stat.S_ISDIR(facts.st_mode) or not os.access(folder, os.W_OK):
        return False
    return os.name != "posix" or (facts.st_uid == os.getuid() and not facts.st_mode & 0o022)
