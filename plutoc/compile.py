"""The pipeline, a line a phase: text → tree → graph → checked graph → plan → files."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

from plutoc.check.model import Checked
from plutoc.check.run import check
from plutoc.diagnostic import Diagnostic, Rejected, accept_or_raise
from plutoc.graph.model import Graph
from plutoc.graph.resolve import resolved
from plutoc.registry import blocks, standard
from plutoc.source import Source
from plutoc.syntax.parse import read

if TYPE_CHECKING:
    from plutoc.emit.package import Package
    from plutoc.plan.model import Plan

Warnings = tuple[Diagnostic, ...]
FindHooks = Callable[[Checked], Source | None]
"""Returns the hooks.py that is there already, if there is one."""
KnownHooks = Callable[[Checked], Mapping[str, str]]
"""Returns the hooks that the app is known to declare, or to have declared before, with their kinds."""
_NONE: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True, slots=True, kw_only=True)
class Compiled:
    """An app from its source to its files."""

    checked: Checked
    hooks: Source | None
    package: Package
    warnings: Warnings


def compile_source(
    source: Source,
    *,
    source_name: str,
    find_hooks: FindHooks,
    optimise: bool = True,
    carry: bool = False,
    known_hooks: KnownHooks = lambda _: _NONE,
) -> Compiled:
    """Return a source's package; raise `Rejected` with all errors of the first phase that fails.

    `carry`: the library that flies goes into the package, too; `NoLibrary` where there is none.
    """
    checked, warnings = analyse(source)
    known = known_hooks(checked)
    hooks = find_hooks(checked)
    warnings += check_hooks(checked, hooks)
    former, left = left_over(checked, hooks, known)
    warnings += left
    package = package_of(
        checked,
        source_name=source_name,
        optimise=optimise,
        carry=carry,
        former=former,
        for_all=policies_for_all(checked, hooks),
    )
    return Compiled(checked=checked, hooks=hooks, package=package, warnings=warnings)


def analyse(source: Source) -> tuple[Checked, Warnings]:
    """Return the checked graph of a source."""
    file, of_syntax = read(source)
    graph, of_names = resolved(file, blocks() if file.uses else standard())
    return check_names_first(graph, (*of_syntax, *of_names))


def check_names_first(graph: Graph, found: Iterable[Diagnostic]) -> tuple[Checked, Warnings]:
    """Return the checked graph, unless something was found about its syntax or its names."""
    warnings = accept_or_raise(found)
    checked, of_graph = check(graph)
    return checked, warnings + of_graph


def check_hooks(checked: Checked, hooks: Source | None) -> Warnings:
    """Hold the developer's own code against the app, where there is any yet."""
    if hooks is None:
        return ()
    from plutoc.hooks.check import check_hooks

    return check_hooks(checked, hooks)


def left_over(
    checked: Checked, hooks: Source | None, known: Mapping[str, str]
) -> tuple[Mapping[str, str], Warnings]:
    """Return the hooks that hooks.py still defines and the app does not declare any more.

    With warnings of those that are of no use there.
    """
    if hooks is None or not known:
        return _NONE, ()
    from plutoc.hooks.former import left_over

    return left_over(checked, hooks, known)


def policies_for_all(checked: Checked, hooks: Source | None) -> frozenset[str]:
    """Return the policies that hooks.py defines as functions of all that wait."""
    if hooks is None:
        return frozenset()
    from plutoc.hooks.check import policies_for_all

    return policies_for_all(checked, hooks)


def planned(checked: Checked, *, optimise: bool = True) -> Plan:
    """Return the plan of a checked graph: as good as we can make it, or as plain as it is built."""
    from plutoc.plan.build import build
    from plutoc.plan.optimise import optimised

    return optimised(build(checked)) if optimise else build(checked)


def package_of(
    checked: Checked,
    *,
    source_name: str,
    optimise: bool = True,
    carry: bool = False,
    former: Mapping[str, str] = _NONE,
    for_all: frozenset[str] = frozenset(),
) -> Package:
    """Return the files of a checked graph's package."""
    from plutoc.emit.errors import not_embeddable, place_of
    from plutoc.emit.modules import EmbedError
    from plutoc.emit.package import emit
    from plutoc.report.graph_file import graph_file
    from plutoc.report.pictures import mermaid

    plan = planned(checked, optimise=optimise)
    try:
        return emit(
            plan,
            source_name=source_name,
            picture=mermaid(checked),
            graph_data=graph_file(checked),
            carry=carry,
            former=former,
            for_all=for_all,
        )
    except EmbedError as error:  # a block of another package
        raise Rejected([not_embeddable(place_of(checked.graph), str(error))]) from error
