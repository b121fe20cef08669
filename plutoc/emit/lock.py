"""`pluto.lock`: what made a package, and the checksums by which a hand edit is noticed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from hashlib import sha256

from plutoc import __version__
from plutoc.emit.markup import toml_text
from plutoc.emit.python import header
from plutoc.registry import GROUP, STD

NAME = "pluto.lock"


def lock(app: str, source_name: str, packages: Iterable[str], files: Mapping[str, str]) -> str:
    """Return the record of an app's owned files, made with these packages of blocks.

    It has the only facts that change without the source: versions, by the names by which apps use
    the packages, and the SHA-256 of each file.
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
        "[files]",
        *(f"{toml_text(path)} = {toml_text(digest)}" for path, digest in digests.items()),
    ]
    return "\n".join(lines) + "\n"


def _of_blocks(package: str) -> str:
    """Return the version of the distribution that brings a package of blocks."""
    from importlib.metadata import entry_points  # slow to import, and ours needs no looking up

    for point in entry_points(group=GROUP, name=package):
        if point.dist is not None:
            return f"{point.dist.name} {point.dist.version}"
    return "not installed"
