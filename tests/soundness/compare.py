"""Holds what `plutoc check` says against what the oracle has seen."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.compile import analyse
from plutoc.diagnostic import Rejected, Severity
from plutoc.source import Source
from tests.soundness.app import App
from tests.soundness.oracle import Judgement, judge

UNSEEN = ("P2001", "P2002", "P2003", "P2004", "P2005", "P2020", "P2024")
"""Codes of what no run can show, and the oracle does not judge: where missions begin,
attributes written twice, and what comes of a Stop, which it does not know."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Compared:
    """An app, judged twice."""

    codes: tuple[str, ...]
    """Of the errors, each once; empty: accepted."""
    judgement: Judgement | None
    """None where the app never comes to the checks of its graph."""

    @property
    def agrees(self) -> bool:
        """Return whether both accept the app, or both refuse it."""
        if self.judgement is None or self.judgement.doubtful:
            return True
        return self.judgement.sound == (not self.codes) or (
            self.judgement.sound and all(code in UNSEEN for code in self.codes)
        )


def compare(app: App) -> Compared:
    """Ask both."""
    codes = refused(app.text)
    if any(code < "P2" for code in codes):
        return Compared(codes=codes, judgement=None)
    return Compared(codes=codes, judgement=judge(app))


def refused(text: str) -> tuple[str, ...]:
    """Return the codes of the errors that the compiler finds."""
    try:
        analyse(Source(path="app.pluto", text=text))
    except Rejected as rejected:
        errors = [d.code for d in rejected.diagnostics if d.severity is Severity.ERROR]
        return tuple(sorted(set(errors)))
    return ()
