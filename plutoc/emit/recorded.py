"""What `pluto.lock` says about a folder: whose it is, and how its files were written."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import field
from pathlib import PurePosixPath

from plutoc import __version__
from plutoc.emit.lock import FORMER, HOOKS, KINDS
from plutoc.emit.merged import sides
from plutoc.frozen import frozen

_LARGEST = 1 << 24
"""In bytes."""


_PRINTED = r"[ !#-\[\]-~]*"
_AS_WRITTEN = re.compile(
    rf'(?:\#{_PRINTED}\n)?app = "(?P<app>\w+)"\n\n'
    rf'\[versions\]\nplutoc = "(?P<made_by>{_PRINTED})"\n(?P<others>(?:\w+ = "{_PRINTED}"\n)*)\n'
    rf'(?:\[{HOOKS}\]\n(?P<hooks>(?:\w+ = "[a-z]+"\n)+)\n)?'
    rf'(?:\[{FORMER}\]\n(?P<former>(?:\w+ = "[a-z]+"\n)+)\n)?'
    r'\[files\]\n(?P<files>(?:"[\w./-]+" = "[0-9a-f]{64}"\n)*)',
    re.ASCII,
)
_LINE = re.compile(
    rf'"(?P<path>[^"\\]+)" = "(?P<digest>[0-9a-f]{{64}})"'
    rf'|(?P<name>\w+) = "(?P<value>{_PRINTED})"|\[\w+\]|\#.*|',
    re.ASCII,
)
"""A line as we write it; what it is can be told without the lines before it."""
_FORGOTTEN = re.compile(rf'\w+ = "(?:{"|".join(KINDS)})"|\[{FORMER}\]|', re.ASCII)
_MADE_BY = re.compile(
    rb"""^[ \t]*"?plutoc"?[ \t]*[=:][ \t]*["']([^"'\r\n]{1,80})["']""", re.MULTILINE
)


class DamagedLock(Exception):
    """It cannot be read. The text says why, for a person."""

    made_by: str | None = None
    """The version of the compiler that wrote it, if that can be made out all the same."""


@frozen
class Lock:
    """The record of a generated package."""

    app: str
    files: Mapping[str, frozenset[str]]
    """Path → SHA-256 of the text that was written, in hexadecimal digits; after a merge of both."""
    made_by: str | None = None
    """The version of the compiler that wrote it; None: one that did not say so, or none of ours."""
    hooks: Mapping[str, str] = field(default_factory=dict)
    """Name → kind of the hooks that the app declares, or has declared before."""
    is_merged: bool = False
    """It has what two branches wrote, one beside the other."""


def is_newer(made_by: str | None, version: str) -> bool:
    """Say whether a newer compiler than this version made it, as PEP 440 orders versions."""
    if made_by is None or made_by == version:
        return False
    from packaging.version import Version  # slow to import, and seldom asked

    return Version(made_by) > Version(version)


def read_lock(data: bytes) -> Lock:
    """Read a record; raise `DamagedLock` where it is not as we write it.

    It may come from a stranger, together with the rest of the folder: no path may lead out of it.
    """
    try:
        if len(data) > _LARGEST:
            raise DamagedLock("it is larger than any that we write")
        return _as_written(data) or _read(data)
    except DamagedLock as error:
        error.made_by = _newest(
            found.decode("utf-8", "replace") for found in _MADE_BY.findall(data)
        )
        raise


def only_forgets(before: str, after: str) -> bool:
    """Say whether one record is the other but for some hooks that were declared before."""
    old, new = before.splitlines(), after.splitlines()
    left = [line for line in old if line not in new]
    return all(line in old for line in new) and all(map(_FORGOTTEN.fullmatch, left))


def _as_written(data: bytes) -> Lock | None:
    """Read what is just as we write it; to import a reader of TOML takes longer than that."""
    match = _AS_WRITTEN.fullmatch(data.decode("utf-8", "replace").replace("\r\n", "\n"))
    if match is None or match["others"]:
        return None
    lines = _pairs(match["files"])
    files = dict(lines)
    odd = any(part in ("", ".", "..") for path in files for part in path.split("/"))
    declared, former = _pairs(match["hooks"] or ""), _pairs(match["former"] or "")
    hooks = dict([*former, *declared])
    unlike = any(kind not in KINDS for kind in hooks.values())
    twice = len(files) < len(lines) or any(
        len(dict(table)) < len(table) for table in (declared, former)
    )
    if odd or unlike or twice:
        return None
    return Lock(
        app=match["app"],
        files={path: frozenset((digest,)) for path, digest in files.items()},
        made_by=_version(match["made_by"]),
        hooks=hooks,
    )


def _pairs(lines: str) -> list[tuple[str, str]]:
    """Return what stands on the two sides of ` = ` in each line, without quotes."""
    parted = (line.partition(" = ") for line in lines.splitlines())
    return [(name.strip('"'), value.strip('"')) for name, _, value in parted]


def _version(written: object) -> str | None:
    """Return a version as it was written; raise `DamagedLock` where it is none."""
    if written is None or written == __version__:
        return __version__ if written else None
    from packaging.version import InvalidVersion, Version

    try:
        return str(Version(str(written)))
    except InvalidVersion:
        raise DamagedLock("the version of plutoc in it is none") from None


def _newest(written: Iterable[str]) -> str | None:
    """Return the newest of some versions; what is none does not count."""
    from packaging.version import InvalidVersion, Version

    found: list[Version] = []
    for one in written:
        try:
            found.append(Version(one))
        except InvalidVersion:
            continue  # what cannot be read has been found to be so already
    return str(max(found)) if found else None


def _read(data: bytes) -> Lock:
    import tomllib

    from plutoc_runtime.alone.toml import line_of_long_key

    try:
        text = data.decode()
        if line_of_long_key(text) is not None:
            raise DamagedLock("one of its keys has too many parts")
        table = tomllib.loads(text)
    except UnicodeDecodeError:
        raise DamagedLock("it is no text") from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        return _of_both_sides(data, str(error))
    app, files, versions = table.get("app"), table.get("files"), table.get("versions")
    if not isinstance(app, str) or not isinstance(files, dict):
        raise DamagedLock("it does not name the app and its files")
    for path, digest in files.items():
        if not isinstance(digest, str) or not _stays_inside(path):
            raise DamagedLock(f"{path!a} is no file of a package")
    made_by = versions.get("plutoc") if isinstance(versions, dict) else None
    return Lock(
        app=app,
        files={path: frozenset((digest,)) for path, digest in files.items()},
        made_by=_version(made_by),
        hooks={**_hooks(table.get(FORMER, {})), **_hooks(table.get(HOOKS, {}))},
    )


def _hooks(table: object) -> dict[str, str]:
    hooks: dict[str, str] = {}
    for name, kind in table.items() if isinstance(table, dict) else ():
        if kind not in KINDS:
            raise DamagedLock(f"{name!a} is no hook")
        hooks[name] = kind
    return hooks


def _of_both_sides(data: bytes, why: str) -> Lock:
    """Read what a merge has left: both sides with marks between them, or their lines mixed.

    Each line as we write it says by itself what it is, so it does not matter in which table the
    merge has put it. `why`: what is wrong with it as TOML.
    """
    both = sides(data)
    if both is None and re.search(rb"^<<<<<<< ", data, re.MULTILINE):
        raise DamagedLock("a merge left its marks in it, and they do not go together")
    apps, versions = set[str](), list[str]()
    files, hooks = dict[str, set[str]](), dict[str, str]()
    for line in (line for side in both or (data,) for line in side.decode().splitlines()):
        match = _LINE.fullmatch(line)
        if match is None:
            raise DamagedLock(why if both is None else f"a merge left {line[:60]!a} in it")
        path, name, value = match["path"], match["name"], match["value"]
        if path is not None:
            if not _stays_inside(path):
                raise DamagedLock(f"{path!a} is no file of a package")
            files.setdefault(path, set()).add(match["digest"])
        elif value in KINDS and (name != "app" or apps):  # a hook may have any name
            hooks[name] = value
        elif name == "app":
            apps.add(value)
        elif name == "plutoc":
            versions.append(_version(value) or value)
    if not apps or not files:
        raise DamagedLock("it does not name the app and its files")
    if len(apps) > 1:
        raise DamagedLock("a merge mixed the records of two apps in it")
    return Lock(
        app=apps.pop(),
        files={path: frozenset(digests) for path, digests in files.items()},
        made_by=_newest(versions),
        hooks=hooks,
        is_merged=True,
    )


def _stays_inside(path: str) -> bool:
    parts = PurePosixPath(path).parts
    return (
        bool(parts)
        and path == "/".join(parts)
        and not path.startswith("/")
        and ".." not in parts
        and not any(char in '\\:*?"<>|' or not char.isprintable() for char in path)
    )
