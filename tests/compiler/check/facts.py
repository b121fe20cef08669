"""What the checks make of a graph, as text: their findings, and of a sound graph all that they found out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from plutoc.block import IN_GRAPH
from plutoc.check.model import Checked
from plutoc.check.run import check
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import build


def told(text: str) -> str:
    """Return what must come of a graph: whether it is refused, and what is said."""
    try:
        checked, warnings = check(build(text))
    except Rejected as rejected:
        return "\n".join(["-- refused", *_all_lines(rejected.diagnostics)])
    return "\n".join(["-- checked", *_all_lines(warnings), *_facts(checked)])


def _all_lines(found: Iterable[Diagnostic]) -> Iterator[str]:
    for diagnostic in found:
        yield from _lines(diagnostic)


def _lines(found: Diagnostic) -> Iterator[str]:
    """Yield the message below its place, then each label, and the help."""
    at = "here" if found.span.end == 0 else _place(found.span.start, found)
    yield f"{found.severity.value} {found.code} at {at}"
    yield f"  {found.message}"
    if found.label:
        yield f"  here: {found.label}"
    for related in found.related:
        yield f"  {_place(related.span.start, found)}: {related.label}"
    for line in (found.help or "").splitlines():
        yield f"    {line}"


def _place(start: int, found: Diagnostic) -> str:
    line, column = found.source.position(start)
    return f"`{found.source.line(line).strip()}`" + (f"+{column - 1}" if column > 1 else "")


def _facts(checked: Checked) -> Iterator[str]:
    """Yield a line for each arrow, each block, each fork; and where missions end and go on."""
    for edge, statuses in checked.carries.items():
        yield f"{edge.source} -> {edge.target}: {_named(statuses)}"
    for name, back in checked.resumes.items():
        yield (
            f"{name}: {_named(checked.arrives[name])} > {_named(checked.leaves[name])}, "
            f"goes on at {', '.join(back) or 'the beginning'}"
        )
    for fork in checked.forks:
        targets = ", ".join(edge.target for edge in fork.branches)
        yield f"fork {fork.node} {fork.status.value} -> [{targets}] -> {fork.gate}"
    for name, status in checked.implicit_ends:
        yield f"ends at {name} {status.value}"
    for name, statuses in checked.entries.items():
        yield f"enters at {name} {_named(statuses)}"
    yield f"explored {checked.explored}"


def _named(statuses: Iterable[Status]) -> str:
    known = set(statuses)
    return ", ".join(status.value for status in IN_GRAPH if status in known) or "none"
