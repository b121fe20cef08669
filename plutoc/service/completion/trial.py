"""Would this be legal here? Each completion is tried: read, and its names and values looked up.

Only what the statement has to do with is looked up with it, so that a trial costs the same in an app
of a thousand blocks. How well it fits the graph is judged by all checks, where the app is small.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

from plutoc.check.run import check
from plutoc.diagnostic import Diagnostic, Rejected, Severity
from plutoc.graph.model import Graph
from plutoc.graph.resolve import resolved
from plutoc.registry import Blocks, blocks, standard
from plutoc.service.completion.hole import Hole
from plutoc.service.symbols import DECLARED, Occurrence, Role, occurrences
from plutoc.source import Source
from plutoc.syntax.again import read_again
from plutoc.syntax.fragment import statements_of
from plutoc.syntax.tree import (
    ActionDecl,
    BadStatement,
    BlockDecl,
    EventDecl,
    FieldsDecl,
    File,
    HookDecl,
    Statement,
)

_NO_NAMES = frozenset(
    {*(Role.KIND, Role.PARAMETER, Role.TYPE, Role.STATUS, Role.TERMINAL, Role.APP), Role.FIELD}
)
"""What an app does not declare by these names."""

Wrong = frozenset[tuple[str, str]]
"""Errors, by code and message: a place may move."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """Something that can be written in a hole, and the statements that this makes."""

    insert: str
    tail: str
    statements: tuple[Statement, ...]


@dataclass(kw_only=True, eq=False)
class Trials:
    """An app without the statement that is being written, to try others in its place."""

    path: str
    text: str
    hole: Hole
    before: File | None = None
    """The tree of an earlier text that was in order."""
    looked_up: int = 0
    """How many statements were looked up so far: what the trials have cost."""

    @cached_property
    def base(self) -> str:
        """The text with nothing where the statement stands."""
        start, end = self.hole.statement
        blank = "".join(c if c in "\r\n" else " " for c in self.text[start:end])
        return self.text[:start] + blank + self.text[end:]

    @cached_property
    def file(self) -> File:
        """The tree of the rest."""
        return read_again(Source(self.path, self.base), self.before)[0]

    @cached_property
    def installed(self) -> Blocks:
        """The packages that can be used."""
        return blocks() if self.file.uses else standard()

    @cached_property
    def _rest(self) -> tuple[Graph, Wrong]:
        graph, found = resolved(self.file, self.installed)
        return graph, _errors(found)

    @property
    def graph(self) -> Graph:
        """The graph of the rest."""
        return self._rest[0]

    @cached_property
    def names(self) -> tuple[Occurrence, ...]:
        """All names of the rest."""
        return occurrences(self.file)

    @cached_property
    def _by_name(self) -> dict[str, dict[int, None]]:
        """Which statements have to do with each name that an app can declare."""
        found: dict[str, dict[int, None]] = {}
        for i, names in enumerate(self._names_of):
            for name in names:
                found.setdefault(name.lower(), {})[i] = None
        return found

    @cached_property
    def _names_of(self) -> list[list[str]]:
        return [_names(statement, self.file) for statement in self.file.app.statements]

    @cached_property
    def _declaring(self) -> dict[str, int]:
        return {
            statement.name.text: i
            for i, statement in enumerate(self.file.app.statements)
            if isinstance(statement, BlockDecl | EventDecl | ActionDecl | HookDecl)
        }

    def legal(self, forms: Iterable[str]) -> Trial | None:
        """Return the first form that can be read, and with which no name or value is wrong."""
        every = tuple(forms)
        for tail in self._tails:
            for insert in every:
                statements = self._statements(insert, tail)
                if statements is not None:
                    trial = Trial(insert=insert, tail=tail, statements=statements)
                    if not self._wrong(trial):
                        return trial
        return None

    @cached_property
    def _tails(self) -> tuple[str, ...]:
        """How a statement that is still open may be closed, to be read at all."""
        closers = self.hole.closers
        return tuple(dict.fromkeys(("", closers, f"{closers} can measure", f"{closers} -> end")))

    def _statements(self, insert: str, tail: str) -> tuple[Statement, ...] | None:
        return statements_of(self._written(insert, tail), len(self.base))

    def _written(self, insert: str, tail: str) -> str:
        """Return the statement with something written in its hole."""
        start, end = self.hole.statement
        before, behind = (
            self.text[start : self.hole.span.start],
            self.text[self.hole.span.end : end],
        )
        return before + insert + behind + tail

    def findings(self, trial: Trial) -> int:
        """Return how much the checks of the graph find then: the fewer, the better it fits."""
        return _findings(self._with(trial, self.file.app.statements), self.installed)

    @cached_property
    def without(self) -> int:
        """How much the checks find without the statement."""
        return _findings(self.file, self.installed)

    def _wrong(self, trial: Trial) -> Wrong:
        """Return what is wrong with the app's names and values then, and was not before."""
        near = self._near(trial.statements)
        self.looked_up += len(near)
        part = self._with(trial, near)
        return _errors(resolved(part, self.installed)[1]) - self._rest[1]

    def _with(self, trial: Trial, others: Iterable[Statement]) -> File:
        """Return the tree of the rest, or of a part of it, with statements in the hole."""
        start = self.hole.statement.start
        written = self._written(trial.insert, trial.tail)
        before = [each for each in others if each.span.start < start]
        behind = [each for each in others if each.span.start >= start]
        app = replace(self.file.app, statements=(*before, *trial.statements, *behind))
        return replace(self.file, source=Source(self.path, self.base + written), app=app)

    def _near(self, new: tuple[Statement, ...]) -> list[Statement]:
        """Return the statements that have to do with these, and the declarations of their names."""
        statements = self.file.app.statements
        kept = {i for i, one in enumerate(statements) if isinstance(one, BadStatement)}
        for statement in new:
            for name in _names(statement, self.file):
                kept |= self._by_name.get(name.lower(), {}).keys()
        if any(isinstance(one, FieldsDecl) for one in new):  # blocks bring fields, too
            fields = FieldsDecl, BlockDecl
            kept |= {i for i, one in enumerate(statements) if isinstance(one, fields)}
        waiting = list(kept)
        while waiting:
            for name in self._names_of[waiting.pop()]:
                i = self._declaring.get(name)
                if i is not None and i not in kept:
                    kept.add(i)
                    waiting.append(i)
        return [statements[i] for i in sorted(kept)]


def _names(statement: Statement, file: File) -> list[str]:
    """Return the names in a statement that an app can declare."""
    alone = replace(file, uses=(), app=replace(file.app, statements=(statement,)))
    found = (one for one in occurrences(alone) if one.role not in _NO_NAMES)
    return [one.name for one in found if one.role in DECLARED or one.role is Role.OPTION]


def _findings(file: File, installed: Blocks) -> int:
    graph, found = resolved(file, installed)
    try:
        return len(found) + len(check(graph)[1])
    except Rejected as rejected:
        return len(found) + 100 * len(rejected.diagnostics)


def _errors(found: Iterable[Diagnostic]) -> Wrong:
    return frozenset((one.code, one.message) for one in found if one.severity is Severity.ERROR)
