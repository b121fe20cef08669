"""What the compiler keeps between runs, in the user's own cache folder.

What is kept there gets unpickled or run, which can do anything: nobody else may be able to write
it, and what is not exactly as it was written, after a crash or on a bad disk, is made anew.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

MOST = 1 << 26
"""How many bytes a shelf may hold before what was not used for longest is taken away."""


def cache_folder(shelf: str = "") -> Path | None:
    """Return the folder, or one in it, or None where it would not be safe or cannot be written."""
    try:
        root = os.environ.get("XDG_CACHE_HOME", "")
        base = Path(root) if os.path.isabs(root) else Path.home() / ".cache"
        folder = base / "pluto"
        if not folder.is_absolute():  # a home beside whatever is worked on is a mistake
            return None
        return folder / shelf if _is_ours(folder) and _is_ours(folder / shelf) else None
    except (OSError, RuntimeError):  # RuntimeError: there is no home folder
        return None


def _is_ours(folder: Path) -> bool:
    """Say whether it is a folder in which the user can write, and nobody else; make one first."""
    try:
        facts = folder.lstat()
    except FileNotFoundError:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        facts = folder.lstat()
    return stat.S_ISDIR(facts.st_mode) and os.access(folder, os.W_OK) and not _is_others(facts)


def cache_file(name: str, shelf: str = "") -> Path | None:
    """Return where something is kept, or None where that would not be safe.

    A file that others could have written is taken away first.
    """
    folder = cache_folder(shelf)
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
        with open(file, "rb") as opened:
            digest, data = opened.readline().rstrip(b"\n"), opened.read()
    except OSError:
        return None
    return data if digest == _digest(made_of, data) else None


def keep(file: Path, made_of: bytes, data: bytes) -> None:
    """Keep something, wholly or not at all; where that cannot be, the next run makes it anew."""
    # not by tempfile, which takes longer to import than this takes
    aside = file.with_name(f".{os.urandom(8).hex()}")
    with suppress(OSError):
        try:
            descriptor = os.open(aside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with open(descriptor, "wb") as written:
                written.write(_digest(made_of, data) + b"\n")
                written.write(data)
            os.replace(aside, file)
        except BaseException:
            with suppress(OSError):
                os.unlink(aside)
            raise


def recalled(shelf: str, made_of: bytes, make: Callable[[], bytes]) -> bytes:
    """Return what is made of something: from the shelf where it was made before, or made now."""
    file = cache_file(sha256(made_of).hexdigest(), shelf)
    if file is None:
        return make()
    data = kept(file, made_of)
    if data is None:
        data = make()
        keep(file, made_of, data)
        if file.name.startswith("0"):  # seldom enough to cost nothing, and often enough
            tidy(file.parent)
    else:
        with suppress(OSError):
            os.utime(file)  # it was of use
    return data


def tidy(shelf: Path, most: int = MOST) -> None:
    """Take away what was not used for longest, where there is too much of all."""
    with suppress(OSError):
        found = sorted(
            (facts.st_mtime_ns, entry.name, facts.st_size)
            for entry in os.scandir(shelf)
            if (facts := entry.stat(follow_symlinks=False))
        )
        total = sum(size for *_, size in found)
        for _, name, size in found:
            if total <= most:
                break
            os.unlink(shelf / name)
            total -= size


def _digest(made_of: bytes, data: bytes) -> bytes:
    whole = sha256(sha256(made_of).digest())
    whole.update(data)
    return whole.hexdigest().encode()


def _is_others(facts: os.stat_result) -> bool:
    """Say whether somebody else can write there."""
    return os.name == "posix" and (facts.st_uid != os.getuid() or bool(facts.st_mode & 0o022))
