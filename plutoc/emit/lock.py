"""`pluto.lock`: what made a package, and the checksums by which a hand edit is noticed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from hashlib import sha256

from plutoc import __version__
from plutoc.emit.markup import toml_text
from plutoc.emit.python import header
from plutoc.graph.model import Graph
from plutoc.registry import GROUP, STD

NAME = "pluto.lock"
HOOKS, FORMER = "hooks", "former_hooks"
"""The tables of the hooks that the app declares, and of those that it has declared before."""
PROBE = "probe"
KINDS = ("action", "evaluator", "modifier", "policy", PROBE)
"""What a hook was declared as; what tells whether an action was done is declared with that."""


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
    from importlib.metadata import entry_points  # slow to import, and ours needs no looking up

    for point in entry_points(group=GROUP, name=package):
        if point.dist is not None:
            return f"{point.dist.name} {point.dist.version}"
    return "not installed"
