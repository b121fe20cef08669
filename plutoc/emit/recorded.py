"""What `pluto.lock` says about a folder: whose it is, and how its files were written."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import PurePosixPath

from plutoc.frozen import frozen

_LARGEST = 1 << 24
"""In bytes."""


_PRINTED = r"[ !#-\[\]-~]*"
_AS_WRITTEN = re.compile(
    rf'(?:\#{_PRINTED}\n)?app = "(?P<app>\w+)"\n\n'
    rf'\[versions\]\nplutoc = "{_PRINTED}"\n(?P<others>(?:\w+ = "{_PRINTED}"\n)*)\n'
    rf'\[files\]\n(?P<files>(?:"[\w./-]+" = "[0-9a-f]{{64}}"\n)*)',
    re.ASCII,
)


class DamagedLock(Exception):
    """It cannot be read. The text says why, for a person."""


@frozen
class Lock:
    """The record of a generated package."""

    app: str
    files: Mapping[str, str]
    """Path → SHA-256 of the text that was written, in hexadecimal digits."""


def read_lock(data: bytes) -> Lock:
    """Read a record; raise `DamagedLock` where it is not as we write it.

    It may come from a stranger, together with the rest of the folder: no path may lead out of it.
    """
    if len(data) > _LARGEST:
        raise DamagedLock("it is larger than any that we write")
    return _as_written(data) or _read(data)


def _as_written(data: bytes) -> Lock | None:
    """Read what is just as we write it; to import a reader of TOML takes longer than that."""
    match = _AS_WRITTEN.fullmatch(data.decode("utf-8", "replace").replace("\r\n", "\n"))
    if match is None or match["others"]:
        return None
    lines = [line.strip('"').split('" = "') for line in match["files"].splitlines()]
    files = dict(lines)
    odd = any(part in ("", ".", "..") for path in files for part in path.split("/"))
    return None if odd or len(files) < len(lines) else Lock(app=match["app"], files=files)


def _read(data: bytes) -> Lock:
    import tomllib

    from plutoc_runtime.files.dotted import line_of_long_key

    try:
        text = data.decode()
        if line_of_long_key(text) is not None:
            raise DamagedLock("one of its keys has too many parts")
        table = tomllib.loads(text)
    except UnicodeDecodeError:
        raise DamagedLock("it is no text") from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        marks = data.startswith(b"<<<<<<< ") or b"\n<<<<<<< " in data
        raise DamagedLock("a merge left its marks in it" if marks else str(error)) from None
    app, files = table.get("app"), table.get("files")
    if not isinstance(app, str) or not isinstance(files, dict):
        raise DamagedLock("it does not name the app and its files")
    for path, digest in files.items():
        if not isinstance(digest, str) or not _stays_inside(path):
            raise DamagedLock(f"{path!a} is no file of a package")
    return Lock(app=app, files=files)


def _stays_inside(path: str) -> bool:
    parts = PurePosixPath(path).parts
    return (
        bool(parts)
        and path == "/".join(parts)
        and not path.startswith("/")
        and ".." not in parts
        and not any(char in '\\:*?"<>|' or not char.isprintable() for char in path)
    )
