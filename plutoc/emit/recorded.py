"""What `pluto.lock` says about a folder: whose it is, and how its files were written."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import PurePosixPath

from plutoc import __version__
from plutoc.frozen import frozen

_LARGEST = 1 << 24
"""In bytes."""


_PRINTED = r"[ !#-\[\]-~]*"
_AS_WRITTEN = re.compile(
    rf'(?:\#{_PRINTED}\n)?app = "(?P<app>\w+)"\n\n'
    rf'\[versions\]\nplutoc = "(?P<made_by>{_PRINTED})"\n(?P<others>(?:\w+ = "{_PRINTED}"\n)*)\n'
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
    made_by: str | None = None
    """The version of the compiler that wrote it; None: one that did not say so, or none of ours."""

    def is_by_newer_than(self, version: str) -> bool:
        """Say whether a newer compiler than this one wrote it, as PEP 440 orders versions."""
        if self.made_by is None or self.made_by == version:
            return False
        from packaging.version import Version  # slow to import, and seldom asked

        return Version(self.made_by) > Version(version)


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
    if odd or len(files) < len(lines):
        return None
    return Lock(app=match["app"], files=files, made_by=_version(match["made_by"]))


def _version(written: object) -> str | None:
    """Return a version as it was written; raise `DamagedLock` where it is none."""
    if written is None or written == __version__:
        return __version__ if written else None
    from packaging.version import InvalidVersion, Version

    try:
        return str(Version(str(written)))
    except InvalidVersion:
        raise DamagedLock("the version of plutoc in it is none") from None


def _read(data: bytes) -> Lock:
    import tomllib

    from plutoc_runtime.dotted import line_of_long_key

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
    app, files, versions = table.get("app"), table.get("files"), table.get("versions")
    if not isinstance(app, str) or not isinstance(files, dict):
        raise DamagedLock("it does not name the app and its files")
    for path, digest in files.items():
        if not isinstance(digest, str) or not _stays_inside(path):
            raise DamagedLock(f"{path!a} is no file of a package")
    made_by = versions.get("plutoc") if isinstance(versions, dict) else None
    return Lock(app=app, files=files, made_by=_version(made_by))


def _stays_inside(path: str) -> bool:
    parts = PurePosixPath(path).parts
    return (
        bool(parts)
        and path == "/".join(parts)
        and not path.startswith("/")
        and ".." not in parts
        and not any(char in '\\:*?"<>|' or not char.isprintable() for char in path)
    )
