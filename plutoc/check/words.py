"""What the checks' sentences are made of: how they name statuses, blocks, forks and ways."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc import diagnostic
from plutoc.check.branches import Astray
from plutoc.check.flow import Fork, Way, ordered
from plutoc.diagnostic import Diagnostic, Related
from plutoc.graph.model import END, Edge, Graph, Node
from plutoc.source import Span
from plutoc_runtime.status import Status


def listed(statuses: Sequence[Status], last: str = "and") -> str:
    """`STANDBY, COMPLETED and FAILED`."""
    return _listed([status.value for status in statuses], last)


def names(blocks: Sequence[str]) -> str:
    """`watch`, `timer` and `first`, each in quotes."""
    return _listed([f"`{name}`" for name in blocks], "and")


def accepts(node: Node) -> str:
    """The statuses that a block takes without a guard."""
    return f"only {listed(ordered(node.block.accepts))}" if node.block.accepts else "no status"


def arrows(blocks: Sequence[str]) -> str:
    """`allocate → launch → watch`."""
    return " → ".join(blocks)


def way_of(way: Way) -> str:
    """`create → allocate → launch (RUNNING) → watch`: a status stands where it changes."""
    parts = []
    before: Status | None = Status.UNEXECUTED
    for hop in way:
        changed = hop.leaving not in (None, before)
        parts.append(f"{hop.node} ({hop.leaving.value})" if changed and hop.leaving else hop.node)
        before = hop.leaving
    return arrows(parts)


def there(way: Way | None) -> str:
    """The shortest way that shows it, as a sentence."""
    return f"The shortest way: {way_of(way)}" if way else ""


def fork_of(fork: Fork) -> str:
    """The fork as a person would call it."""
    return f"the fork at `{fork[0]}` ({fork[1].value})"


def error(
    code: str,
    at: tuple[Graph, Span],
    message: str,
    *,
    label: str = "",
    related: tuple[Related, ...] = (),
    help: str,
) -> Diagnostic:
    """An error of these facts."""
    source, span = at[0].source, at[1]
    return diagnostic.error(
        code, message, source, span, label=label, related=related, help=help.rstrip()
    )


def warning(
    code: str,
    at: tuple[Graph, Span],
    message: str,
    *,
    label: str = "",
    related: tuple[Related, ...] = (),
    help: str,
) -> Diagnostic:
    """A warning of these facts."""
    source, span = at[0].source, at[1]
    return diagnostic.warning(
        code, message, source, span, label=label, related=related, help=help.rstrip()
    )


def related_to(graph: Graph, span: Span, label: str) -> Related:
    """Another place of the same source."""
    return Related(source=graph.source, span=span, label=label)


def emits_here(graph: Graph, edge: Edge, leaving: Sequence[Status]) -> Related:
    """What the block before an arrow emits."""
    return related_to(graph, graph.node[edge.source].name_span, f"emits {listed(leaving)}")


def is_flown(astray: Astray) -> bool:
    """Does a branch come to a block that flies its mission, and not to an end?"""
    place, leaving = astray
    return place.node != END and leaving is None


def fate(astray: Astray) -> str:
    """What becomes of a branch that does not close."""
    place, leaving = astray
    if leaving is None:
        return f"reaches `{place.node}` first"
    return f"ends at `{place.node}`, where no arrow takes {leaving.value}"


def taken_by(node: Node, status: Status, taker: str | None) -> str:
    """What to add where no arrow takes a status."""
    if taker is None:
        return f"add a block that accepts {status.value}"
    return f"add `{node.name} -> {taker} when {status.value}`"


def _listed(words: Sequence[str], last: str) -> str:
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} {last} {words[-1]}"
