"""`use`: the packages of blocks that a file names, and the kinds it can write."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from plutoc.block import Block, EventParam, HookParam, Param
from plutoc.diagnostic import Diagnostic
from plutoc.graph import errors, value_errors
from plutoc.graph.names import near
from plutoc.graph.uncertain_names import UncertainNames
from plutoc.registry import STD, Blocks, RegistryError
from plutoc.source import Source
from plutoc.syntax.tree import BlockDecl, File, Name


@dataclass(frozen=True, slots=True, kw_only=True)
class Packages:
    """What the prefixes of a file stand for."""

    names: Mapping[str, str]
    """Prefix → package."""
    kinds: Mapping[str, Mapping[str, Block] | None]
    """Package → its blocks; None where they cannot be had, which is told already."""


def packages_of(file: File, blocks: Blocks, found: list[Diagnostic]) -> Packages:
    """Load what the file uses."""
    kinds: dict[str, Mapping[str, Block] | None] = {}
    kinds[STD] = _load(STD, file.source, file.app.name, blocks, found)
    names: dict[str, str] = {}
    used = {use.package.text for use in file.uses}
    for use in file.uses:
        package = use.package.text
        if package not in blocks.packages:
            unused = [other for other in blocks.packages if other != STD and other not in used]
            found.append(errors.unknown_package(file.source, use.package, unused))
            kinds[package] = None
        elif package not in kinds:
            kinds[package] = _load(package, file.source, use.package, blocks, found)
        names.setdefault((use.alias or use.package).text, package)
    return Packages(names=names, kinds=kinds)


def unused_packages(file: File) -> list[Diagnostic]:
    """Find what is used for nothing."""
    prefixes = {
        statement.prefix.text
        for statement in file.app.statements
        if isinstance(statement, BlockDecl) and statement.prefix
    }
    return [
        errors.unused_package(file.source, use.package, use.span)
        for use in file.uses
        if (use.alias or use.package).text not in prefixes
    ]


def _load(
    package: str, source: Source, name: Name, blocks: Blocks, found: list[Diagnostic]
) -> Mapping[str, Block] | None:
    try:
        return blocks.of(package)
    except RegistryError as error:
        found.append(errors.broken_package(source, package, name.span, str(error)))
        return None


def find(
    source: Source,
    declared: BlockDecl,
    packages: Packages,
    unclear: UncertainNames,
    found: list[Diagnostic],
) -> tuple[str, Block] | None:
    """Return the package and the block that a declaration names, or None where there is none."""
    package = STD
    if declared.prefix:
        if declared.prefix.text not in packages.names:
            if unclear.may_declare(declared.prefix.text):
                return None
            wanted = declared.kind.text
            fitting = [
                p for p, of in packages.names.items() if wanted in (packages.kinds[of] or {})
            ]
            found.append(errors.unknown_prefix(source, declared.prefix, fitting))
            return None
        package = packages.names[declared.prefix.text]
    kinds = packages.kinds[package]
    if kinds is None:
        return None
    kind = declared.kind
    if kind.text in kinds:
        return package, kinds[kind.text]
    elsewhere = _elsewhere(kind.text, packages)
    fitting = [] if elsewhere else _meant(kind.text, kinds, declared)
    owner = package if declared.prefix else None
    found.append(errors.unknown_kind(source, kind, owner, list(kinds), fitting, elsewhere))
    if fitting:
        found.extend(_misspelt(source, kinds[fitting[0]], declared))
    return None


def _meant(name: str, kinds: Mapping[str, Block], declared: BlockDecl) -> list[str]:
    """Return the kinds that were probably meant: what is given fits them, or nearly, or does not."""
    similar = near(name, kinds, most=len(kinds))
    fits = [[k for k in similar if _fits(kinds[k], declared, slips)] for slips in (False, True)]
    return next(filter(None, [*fits, similar]), [])[:3]


def _fits(block: Block, declared: BlockDecl, slips: bool) -> bool:
    """Return whether a declaration could be one of this block, if need be with misspelt parameters."""
    given = {argument.name.text for argument in declared.arguments}
    own = {param.name for param in block.params}
    passes = any(isinstance(param, HookParam) and param.passes for param in block.params)
    required = {
        p.name for p in block.params if isinstance(p, Param | HookParam | EventParam) and p.required
    }
    if slips:
        given = {next(iter(near(each, own - given)), each) for each in given - own} | given & own
    return required <= given and (passes or given <= own)


def _misspelt(source: Source, block: Block, declared: BlockDecl) -> list[Diagnostic]:
    """Find misspelt parameters of the kind that was probably meant; others may be right in another."""
    given = {argument.name.text: argument.name for argument in declared.arguments}
    own = [param.name for param in block.params]
    return [
        value_errors.unknown_argument(source, name, f"`{block.name}`", own, given)
        for text, name in given.items()
        if text not in own and near(text, [each for each in own if each not in given])
    ]


def _elsewhere(kind: str, packages: Packages) -> list[str]:
    """Return how to write a kind that exists, only with another prefix."""
    found = [
        f"{prefix}.{kind}"
        for prefix, package in packages.names.items()
        if kind in (packages.kinds[package] or {})
    ]
    return [kind, *found] if kind in (packages.kinds[STD] or {}) else found
