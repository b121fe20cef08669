"""Phrases of the checks' messages: statuses, blocks, forks and paths."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from plutoc.check.branches import Astray
from plutoc.check.flow import Fork, Hop, Way, ordered
from plutoc.diagnostic import Diagnostic, Fix, Related, Severity
from plutoc.graph.model import END, Edge, Graph, Node
from plutoc.source import Span
from plutoc.syntax.tokens import joined
from plutoc_runtime.domain.status import Status

_WIDEST_WAY = 88
_LONGEST_WAY = 60
"""Blocks of a way that are shown; of a longer one, its beginning and its end."""


def listed(statuses: Sequence[Status], last: str = "and") -> str:
    """`STANDBY, COMPLETED and FAILED`."""
    return joined([status.value for status in statuses], last)


def accepts(node: Node) -> str:
    """The statuses that a block takes without a guard."""
    return f"only {listed(ordered(node.block.accepts))}" if node.block.accepts else "no status"


def arrows(blocks: Sequence[str]) -> str:
    """`allocate → launch → watch`."""
    return " → ".join(blocks)


def _there(shown: Sequence[Way]) -> str:
    """The shortest paths that show it, on lines of their own, below the help."""
    if not shown:
        return ""
    head = f"the shortest way{'s' if len(shown) > 1 else ''} there:"
    return "\n".join(["", head, *(f"  {line}" for way in shown for line in _wrapped(way))])


def _wrapped(way: Way) -> list[str]:
    lines = [""]
    for hop in _hops(way):
        step = f" → {hop}" if lines[-1] else hop
        if len(lines[-1]) + len(step) > _WIDEST_WAY:
            lines.append(f" {step}")
        else:
            lines[-1] += step
    return lines


def _hops(way: Way) -> list[str]:
    if len(way) <= _LONGEST_WAY:
        return [_hop(hop) for hop in way]
    half = _LONGEST_WAY // 2
    between = f"… {len(way) - 2 * half:,} more …"
    return [*map(_hop, way[:half]), between, *map(_hop, way[-half:])]


def _hop(hop: Hop) -> str:
    """`launch (RUNNING)`: a block, and how it is left."""
    return f"{hop.node} ({hop.leaving.value})" if hop.leaving else hop.node


def fork_of(fork: Fork) -> str:
    """The fork as a person would call it."""
    return f"the fork at `{fork[0]}` ({fork[1].value})"


def or_guarded(graph: Graph, fork: Fork) -> str:
    """The other way to mend a fork that may not be meant, if its block has more than one answer."""
    node = graph.node[fork[0]]
    status = fork[1]
    answers = {answer for taken in node.block.accepts_by_guard for answer in node.emitted(taken)}
    if answers == {status}:
        return ""
    return (
        f"; or, if only one of the arrows from `{node.name}` was meant to take {status.value}, "
        "guard the others with `when`"
    )


def _found(
    code: str,
    at: tuple[Graph, Span],
    message: str,
    *,
    severity: Severity,
    label: str = "",
    related: tuple[Related, ...] = (),
    help: str,
    ways: Sequence[Way | None] = (),
    fix: Fix | None = None,
) -> Diagnostic:
    """A finding about these facts; `ways` are shortest paths that show it."""
    shown = [way for way in ways if way is not None]
    return Diagnostic(
        code,
        message,
        at[0].source,
        at[1],
        severity=severity,
        label=label,
        related=related,
        help=f"{help}{_there(shown)}".rstrip(),
        fix=fix,
        path=_path(shown),
    )


error = partial(_found, severity=Severity.ERROR)
warning = partial(_found, severity=Severity.WARNING)


def _path(ways: Sequence[Way]) -> tuple[tuple[str, str | None], ...]:
    """The first path, for a picture to walk."""
    return tuple((hop.node, hop.leaving and hop.leaving.value) for hop in ways[0]) if ways else ()


def related_to(graph: Graph, span: Span, label: str) -> Related:
    """Another place of the same source."""
    return Related(source=graph.source, span=span, label=label)


def emits_here(graph: Graph, edge: Edge, leaving: Sequence[Status]) -> Related:
    """A note on what the block before an arrow emits."""
    here = f"emits {listed(leaving)}"
    return related_to(graph, graph.node[edge.source].name_span, here)


def whole_mission(graph: Graph) -> str:
    """How a mission is limited as a whole, which blocks that limit a flight do not do."""
    allocates = next((node.name for node in graph.nodes if node.block.allocates), "the allocator")
    return (
        "to limit the mission as a whole, give it a `deadline` in the missions file, and "
        f"`fail_late: yes` to `{allocates}`, if it shall end then"
    )


def is_flown(astray: Astray) -> bool:
    """Whether a branch reaches a block that flies its mission, and not an end."""
    place, leaving = astray
    return place.node != END and leaving is None


def fate(astray: Astray) -> str:
    """How a branch that does not close ends."""
    place, leaving = astray
    if leaving is None:
        return f"reaches `{place.node}` first"
    return f"ends at `{place.node}`, where no arrow takes {leaving.value}"


def before_allocation(graph: Graph, node: Node) -> str:
    """Where a block stands that holds missions: "before a drone is allocated, as in `a -> b -> c`"."""
    ways = (
        f", as in `{edge.source} -> {node.name} -> {edge.target}`"
        for edge in graph.edges
        if edge.target in graph.node
        and graph.node[edge.target].block.allocates
        and edge.source != node.name
    )
    return f"before a drone is allocated{next(ways, '')}"


def taken_by(node: Node, status: Status, taker: str | None) -> str:
    """The arrow to add if none takes a status."""
    if taker is None:
        return f"add a block that accepts {status.value}"
    return f"add `{node.name} -> {taker} when {status.value}`"


def emits_nothing(graph: Graph, node: Node) -> tuple[Related, ...]:
    """Notes on a block that hands a flight on, and on its hook."""
    assert node.hook is not None
    return (
        related_to(graph, node.hook.span, "it has no `emits`"),
        related_to(graph, node.name_span, "so the mission goes on as it came here, RUNNING"),
    )


def with_emits(node: Node, ends: Sequence[Status]) -> str:
    """How to write the hook of a block, so that it says how the flight ended."""
    hook = node.hook
    assert hook is not None
    takes = "(…)" if hook.parameters else ""
    emits = ", ".join(status.value for status in ends)
    writes = f" writes {', '.join(hook.writes)}" if hook.writes else ""
    return (
        f"`{hook.name}` has no `emits`: write `{hook.kind.value} {hook.name}{takes} emits {emits}"
        f"{writes}`, and let it return one of them"
    )
