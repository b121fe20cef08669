"""`pluto.lock`: what made a package, and the checksums by which a hand edit is noticed."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from importlib.metadata import entry_points
from pathlib import PurePosixPath

from packaging.version import InvalidVersion, Version

from plutoc import __version__
from plutoc.emit.markup import header, toml_text
from plutoc.emit.merge_conflicts import sides
from plutoc.graph.model import Graph
from plutoc.registry import GROUP, STD

NAME = "pluto.lock"
HOOKS, FORMER = "hooks", "former_hooks"
"""The tables of the hooks that the app declares, and of those that it has declared before."""
PROBE = "probe"
KINDS = ("action", "evaluator", "modifier", "policy", "creator", PROBE)
"""What a hook was declared as; what tells whether an action was done is declared with that."""
_LARGEST = 1 << 24
"""In bytes."""
_PRINTED = r"[ !#-\[\]-~]*"
_LINE = re.compile(
    rf'"(?P<path>[^"\\]+)" = "(?P<digest>[0-9a-f]{{64}})"'
    rf'|(?P<name>\w+) = "(?P<value>{_PRINTED})"|\[\w+\]|\#.*|',
    re.ASCII,
)
"""A line as we write it; what it is can be told without the lines before it."""
_LONG_KEY = re.compile(r"(?:[\w-]+[ \t]*\.[ \t]*){100}")
"""`tomllib` copies for each part of a key all before it."""
_FORGOTTEN = re.compile(rf'\w+ = "(?:{"|".join(KINDS)})"|\[{FORMER}\]|', re.ASCII)
_MADE_BY = re.compile(
    rb"""^[ \t]*"?plutoc"?[ \t]*[=:][ \t]*["']([^"'\r\n]{1,80})["']""", re.MULTILINE
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Hooks:
    """The functions of the developer's that a package knows of, by name, and of what kind each is."""

    declared: Mapping[str, str]
    former: Mapping[str, str]
    """Those that are still defined, though the app does not declare them any more."""


def hooks_of(graph: Graph) -> dict[str, str]:
    """Return the names of all hooks that an app declares, actions among them, and their kinds."""
    kinds = {action.name: "action" for action in graph.actions}
    return kinds | {hook.name: hook.kind.value for hook in graph.hooks}


def lock(
    app: str,
    source_name: str,
    packages: Iterable[str],
    files: Mapping[str, str],
    hooks: Hooks | None = None,
) -> str:
    """Return the record of an app's owned files, made with these packages of blocks.

    It has the only facts that change without the source: versions, by the names by which apps use
    the packages, the SHA-256 of each file, and which hooks were declared before.
    """
    others = sorted(set(packages) - {STD})
    versions = {"plutoc": __version__, **{package: _of_blocks(package) for package in others}}
    digests = {path: sha256(text.encode()).hexdigest() for path, text in sorted(files.items())}
    lines = [
        f"# {header(source_name)}",
        f"app = {toml_text(app)}",
        "",
        "[versions]",
        *(f"{package} = {toml_text(of_it)}" for package, of_it in versions.items()),
        "",
        *(_table(HOOKS, hooks.declared) if hooks else ()),
        *(_table(FORMER, hooks.former) if hooks else ()),
        "[files]",
        *(f"{toml_text(path)} = {toml_text(digest)}" for path, digest in digests.items()),
    ]
    return "\n".join(lines) + "\n"


def _table(name: str, hooks: Mapping[str, str]) -> Iterator[str]:
    if hooks:
        yield f"[{name}]"
        yield from (f"{hook} = {toml_text(kind)}" for hook, kind in sorted(hooks.items()))
        yield ""


def _of_blocks(package: str) -> str:
    """Return the version of the distribution that brings a package of blocks."""
    for point in entry_points(group=GROUP, name=package):
        if point.dist is not None:
            return f"{point.dist.name} {point.dist.version}"
    return "not installed"


class DamagedLock(Exception):
    """The lock cannot be read. The text says why."""

    made_by: str | None = None
    """The version of the compiler that wrote it, if that can be made out all the same."""


@dataclass(frozen=True, slots=True, kw_only=True)
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
    """Whether it has the lines of two merged branches."""


def is_newer(made_by: str | None, version: str) -> bool:
    """Return whether a newer compiler than this version made it, as PEP 440 orders versions."""
    if made_by is None or made_by == version:
        return False
    return Version(made_by) > Version(version)


def read_lock(data: bytes) -> Lock:
    """Read a record; raise `DamagedLock` where it is not as we write it.

    It may come from a stranger, together with the rest of the folder: no path may lead out of it.
    """
    try:
        if len(data) > _LARGEST:
            raise DamagedLock("it is larger than any that we write")
        return _read(data)
    except DamagedLock as error:
        error.made_by = _newest(
            found.decode("utf-8", "replace") for found in _MADE_BY.findall(data)
        )
        raise


def only_forgets(before: str, after: str) -> bool:
    """Return whether one record is the other but for some hooks that were declared before."""
    old, new = before.splitlines(), after.splitlines()
    left = [line for line in old if line not in new]
    return all(line in old for line in new) and all(map(_FORGOTTEN.fullmatch, left))


def _version(written: object) -> str | None:
    """Return a version as it was written; raise `DamagedLock` where it is none."""
    if written is None or written == __version__:
        return __version__ if written else None
    try:
        return str(Version(str(written)))
    except InvalidVersion:
        raise DamagedLock("the version of plutoc in it is none") from None


def _newest(written: Iterable[str]) -> str | None:
    """Return the newest of some versions; what is none does not count."""
    found: list[Version] = []
    for one in written:
        try:
            found.append(Version(one))
        except InvalidVersion:
            continue  # what cannot be read has been found to be so already
    return str(max(found)) if found else None


def _read(data: bytes) -> Lock:
    try:
        text = data.decode()
        if _LONG_KEY.search(text):
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
