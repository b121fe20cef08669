"""What the compiler keeps between runs, in the user's own cache folder.

What is kept there gets unpickled or run, which can do anything: nobody else may be able to write
it, and what is not exactly as it was written, after a crash or on a bad disk, is made anew.
"""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from hashlib import sha256
from pathlib import Path


def cache_folder() -> Path | None:
    """Return the folder, or None where it would not be safe or cannot be written."""
    try:
        root = os.environ.get("XDG_CACHE_HOME", "")
        base = Path(root) if os.path.isabs(root) else Path.home() / ".cache"
        folder = base / "pluto"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        facts = folder.lstat()
        if not stat.S_ISDIR(facts.st_mode) or not os.access(folder, os.W_OK):
            return None
        return None if _is_others(facts) else folder
    except (OSError, RuntimeError):  # RuntimeError: there is no home folder
        return None


def cache_file(name: str) -> Path | None:
    """Return where something is kept, or None where that would not be safe.

    A file that others could have written is taken away first.
    """
    folder = cache_folder()
    if folder is None:
        return None
    file = folder / name
    try:
        facts = file.lstat()
        if not stat.S_ISREG(facts.st_mode) or _is_others(facts):
            file.unlink()
    except FileNotFoundError:
        pass
    except OSError:
        return None
    return file


def kept(file: Path, made_of: bytes) -> bytes | None:
    """Return what is kept, or None where nothing is, or not what was made of this."""
    try:
        digest, _, data = file.read_bytes().partition(b"\n")
    except OSError:
        return None
    return data if digest == _digest(made_of, data) else None


def keep(file: Path, made_of: bytes, data: bytes) -> None:
    """Keep something, wholly or not at all; where that cannot be, the next run makes it anew."""
    from tempfile import mkstemp

    with suppress(OSError):
        descriptor, aside = mkstemp(prefix=".", dir=file.parent)  # for the user alone
        try:
            with open(descriptor, "wb") as written:
                written.write(_digest(made_of, data) + b"\n" + data)
            os.replace(aside, file)
        except BaseException:
            os.unlink(aside)
            raise


def _digest(made_of: bytes, data: bytes) -> bytes:
    return sha256(sha256(made_of).digest() + data).hexdigest().encode()


def _is_others(facts: os.stat_result) -> bool:
    """Say whether somebody else can write there."""
    return os.name == "posix" and (facts.st_uid != os.getuid() or bool(facts.st_mode & 0o022))
