"""A finding of the compiler about a source: one value, from which every output format is made.

Codes: P0 syntax, P1 names, types and units, P2 graph, P3 hooks, P4 generated files, P9 internal. A
code is never used twice, not even after its diagnostic is gone.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import KW_ONLY, dataclass
from enum import Enum
from functools import partial

from plutoc.source import Source, Span


class Severity(Enum):
    """An error stops the compiler; a warning does not."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True)
class Related:
    """Another place that has to do with it, and how."""

    source: Source
    span: Span
    label: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Fix:
    """A change that certainly mends it: put this text in place of the span."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding: what is wrong, where, what has to do with it, and what to do."""

    code: str
    message: str
    source: Source
    span: Span
    _: KW_ONLY
    severity: Severity
    label: str = ""
    related: tuple[Related, ...] = ()
    help: str | None = None
    fix: Fix | None = None
    path: tuple[tuple[str, str | None], ...] = ()
    """The shortest way that shows it: blocks, and the status with which each is left."""


error = partial(Diagnostic, severity=Severity.ERROR)
warning = partial(Diagnostic, severity=Severity.WARNING)


def arranged(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return findings as every report tells them: file by file, by place, each once.

    The files keep the order in which they come.
    """
    once = tuple(dict.fromkeys(found))
    files = {d.source.path: i for i, d in reversed(tuple(enumerate(once)))}
    return tuple(
        sorted(once, key=lambda d: (files[d.source.path], d.span.start, d.span.end, d.code))
    )


class Rejected(Exception):
    """A phase found errors. It carries all of them, and the warnings found on the way."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(f"{d.code}: {d.message}" for d in self.diagnostics))


def in_order(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of one source as they stand in it."""
    return tuple(sorted(found, key=lambda d: (d.span.start, d.span.end, d.code)))


def accept_or_raise(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return the warnings; raise `Rejected` with everything where there is an error among them."""
    diagnostics = in_order(found)
    if any(d.severity is Severity.ERROR for d in diagnostics):
        raise Rejected(diagnostics)
    return diagnostics
