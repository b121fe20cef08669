"""An app as it is being written: its text, and all that the compiler can say of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType

from plutoc.check import reach
from plutoc.check.model import Checked
from plutoc.check.statuses import creation, explore
from plutoc.compile import check_hooks, check_names_first
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.graph.model import Edge, Graph
from plutoc.graph.resolve import resolved
from plutoc.registry import Blocks, blocks, standard
from plutoc.service.symbols import Occurrence, occurrences
from plutoc.source import Source
from plutoc.syntax.again import is_sound, read_again
from plutoc.syntax.tree import File
from plutoc_runtime.domain.status import Status

FindHooks = Callable[[Graph], Source | None]
"""Returns the hooks.py that counts for an app, if there is one."""

_OF_HOOKS = frozenset({"hooks", "diagnostics"})
"""What depends on hooks.py."""


@dataclass(frozen=True, kw_only=True)
class Document:
    """One version of an app's text, with all that the compiler can say of it.

    Nothing is analysed before it is asked for, and nothing twice. Any text has an answer, however
    broken: the tree and the graph are then as much as is clear.
    """

    path: str
    text: str
    find_hooks: FindHooks = lambda _: None
    """The only question that is asked of the world."""
    before: File | None = field(default=None, repr=False, compare=False)
    """The tree of an earlier text that was in order: what has not changed is not read again."""

    @cached_property
    def source(self) -> Source:
        """The text, with its lines and columns."""
        return Source(self.path, self.text)

    @cached_property
    def _read(self) -> tuple[File, tuple[Diagnostic, ...]]:
        return read_again(self.source, self.before)

    @property
    def sound(self) -> File | None:
        """The tree of the last text that was in order, which may be this one."""
        return self.file if is_sound(*self._read) else self.before

    @property
    def file(self) -> File:
        """The tree."""
        return self._read[0]

    @cached_property
    def names(self) -> tuple[Occurrence, ...]:
        """All names in it, with their places."""
        return occurrences(self.file)

    @cached_property
    def installed(self) -> Blocks:
        """The packages of blocks that it can use."""
        return blocks() if self.file.uses else standard()

    @cached_property
    def _resolved(self) -> tuple[Graph, list[Diagnostic]]:
        return resolved(self.file, self.installed)

    @property
    def graph(self) -> Graph:
        """As much of the graph as is clear."""
        return self._resolved[0]

    @property
    def of_names(self) -> tuple[Diagnostic, ...]:
        """What is found about its syntax and its names."""
        return (*self._read[1], *self._resolved[1])

    @cached_property
    def _checked(self) -> tuple[Checked | None, tuple[Diagnostic, ...]]:
        try:
            return check_names_first(self.graph, self.of_names)
        except Rejected as rejected:
            return None, rejected.diagnostics

    @property
    def checked(self) -> Checked | None:
        """The graph with what the checks found out; None where it has errors."""
        return self._checked[0]

    @cached_property
    def hooks(self) -> Source | None:
        """The hooks.py that counts, if there is one: in whose package it is, any graph says."""
        return self.find_hooks(self.graph)

    def with_hooks_anew(self) -> Document:
        """Return the same text, whose hooks.py is looked for once more."""
        again = replace(self)
        known = {name: value for name, value in vars(self).items() if name not in _OF_HOOKS}
        vars(again).update(known)
        return again

    @cached_property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """What `plutoc check` says of it: of its syntax, names, graph and hooks."""
        checked, found = self._checked
        if checked is None:
            return found
        try:
            return found + check_hooks(checked, self.hooks)
        except Rejected as rejected:
            return found + rejected.diagnostics

    @cached_property
    def carries(self) -> Mapping[Edge, frozenset[Status]]:
        """The statuses that pass along each edge, as far as missions get in a graph with errors.

        Empty where no mission can be followed at all.
        """
        if self.checked is not None:
            return self.checked.carries
        creators, edges, _ = reach.entry(self.graph)
        if not creators:
            return MappingProxyType({})
        try:
            begun = [creation(node.name) for node in creators]
            return explore(self.graph, edges, begun).carries
        except Rejected:  # too tangled to be followed, which is told
            return MappingProxyType({})
