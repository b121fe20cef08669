"""`check --fix`: makes the changes that are certain, and no other."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from plutoc.diagnostic import Diagnostic, Severity
from plutoc.edits import applied, compatible
from plutoc.source import Source

_ROUNDS = 10
"""What is mended may show more that can be; in so many rounds everything is."""

_NAMED = 20
"""Of so many it is told where they were."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mended:
    """A source as it is after its fixes, what they mended, and what is left."""

    source: Source
    fixed: tuple[Diagnostic, ...]
    left: tuple[Diagnostic, ...]


Findings = Callable[[Source], tuple[Diagnostic, ...]]
"""Says what is wrong with a source."""


def mended(source: Source, findings: Findings) -> Mended:
    """Return what fixing makes of a source; nothing is written.

    After each round it is checked anew. If that shows an error which was not there, the round does
    not count: then a fix was not as certain as it said.
    """
    fixed: tuple[Diagnostic, ...] = ()
    found = findings(source)
    for _ in range(_ROUNDS):
        now = compatible([d for d in found if d.source == source])
        if not now:
            break
        text = applied(source, dict.fromkeys(d.fix for d in now if d.fix))
        after = Source(source.path, text)
        left = findings(after)
        if _has_new_errors(found, left):
            break
        fixed, source, found = fixed + now, after, left
    return Mended(source=source, fixed=fixed, left=found)


def summary(done: Mended) -> str:
    """Say what was fixed: `crop.pluto: fixed 2 of 3: P1010 in line 2, P2052 in line 17`."""
    each = [f"{d.code} in line {d.source.position(d.span.start)[0]}" for d in done.fixed[:_NAMED]]
    more = f" and {len(done.fixed) - _NAMED} more" if len(done.fixed) > _NAMED else ""
    count = f"{len(done.fixed)} of {len(done.fixed) + len(done.left)}"
    return f"{done.source.path}: fixed {count}: {', '.join(each)}{more}"


def _has_new_errors(before: Sequence[Diagnostic], after: Sequence[Diagnostic]) -> bool:
    """Return whether mending brought errors, other than those that could not be seen before.

    While there are errors of one group, say P0, the later groups are not, or not wholly, looked at.
    """
    old = _errors(before)
    looked_at = min((code[:2] for code, _ in old), default="P9")
    new = _errors(after) - old
    return any(code[:2] <= looked_at for code, _ in new)


def _errors(found: Sequence[Diagnostic]) -> Counter[tuple[str, str]]:
    return Counter((d.code, d.message) for d in found if d.severity is Severity.ERROR)
