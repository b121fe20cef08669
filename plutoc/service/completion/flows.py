"""What may stand in a flow: blocks, `start`, `end`, guards."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lark import Token

from plutoc.block import IN_GRAPH
from plutoc.graph.model import END, START
from plutoc.service.answers import Sort
from plutoc.service.completion.candidate import Candidate
from plutoc.service.completion.declarations import keyword
from plutoc.service.completion.hole import Hole
from plutoc.service.known import Known
from plutoc.service.reading import describe
from plutoc.syntax.tokens import ARROW, NAME
from plutoc_runtime.domain.status import Status

_LIKELY, _UNREACHED, _UNLIKELY = -1_000, -2_000, 5_000


def flow(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give what may stand in a flow that has begun."""
    types, last = hole.types, hole.types[-1]
    if "WHEN" in types:
        if last in ("WHEN", "COMMA"):
            yield from _statuses(hole, known)
    elif last == ARROW or (hole.opened and last in ("LSQB", "COMMA")):
        yield from blocks(hole, known)
    elif ARROW in types and not hole.opened:
        free = [status.value for status in _free(hole, known)]
        yield keyword("when", "when", *(f"when {status}" for status in free))
        yield keyword("otherwise", rank=1)


def blocks(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give the blocks that a stop can be; at the beginning the sources, else `end`."""
    begins = ARROW not in hole.types
    beside = {str(token) for token in hole.before[hole.opened[-1] :]} if hole.opened else set()
    sources = _stop(hole.before[: _last_arrow(hole.before)]) if not begins else []
    for i, name in enumerate((*known.blocks, *(known.sources if begins else (END,)))):
        if name in beside:
            continue
        rank = (_from if begins else _to)(known, name, sources) + i
        node = known.graph.node.get(name)
        yield Candidate(
            label=name,
            kind=Sort.BLOCK if node else Sort.KEYWORD,
            detail=node.block.name if node else "event" if name in known.events else "",
            doc=describe.code(node.declaration) if node else _of_source(known, name),
            rank=rank,
            judged=True,
        )


def _of_source(known: Known, name: str) -> str:
    """Describe a stop that is no block."""
    if name in (START, END):
        return describe.KEYWORDS[name]
    event = next((one for one in known.graph.events if one.name == name), None)
    return describe.of_event(name, event, ())


def _from(known: Known, name: str, _: Sequence[str]) -> int:
    """Rank a block by whether it is left with statuses that no arrow takes yet."""
    if name in known.own_sources:
        return 0 if known.graph.outgoing.get(name) else _UNREACHED
    if name in known.sources:
        return _UNLIKELY
    return _LIKELY if known.leaves(name) - known.taken_from(name) else 0


def _to(known: Known, name: str, sources: Sequence[str]) -> int:
    """Rank a block by whether it lacks an arrow, and takes what the arrow can bring."""
    brings = frozenset().union(*(known.leaves(s) - known.taken_from(s) for s in sources))
    rank = 0 if brings & known.accepts(name) or not sources else _UNLIKELY
    there = (edge.target for s in sources for edge in known.graph.outgoing.get(s, ()))
    if name in sources or name in there:
        rank += _UNLIKELY
    return rank + (_UNREACHED if not known.graph.incoming.get(name) else 0)


def _statuses(hole: Hole, known: Known) -> Iterator[Candidate]:
    named = {str(token) for token in (*hole.before, *hole.behind)}
    free = _free(hole, known)
    stops = hole.before[: hole.types.index("WHEN")]
    sources = _stop(stops[: _last_arrow(stops)])
    possible = frozenset().union(*(known.leaves(name) for name in sources))
    for i, status in enumerate(IN_GRAPH):
        if status.value in named or status not in possible:
            continue
        yield Candidate(
            label=status.value,
            kind=Sort.STATUS,
            detail="" if status in free else "another arrow takes it, too: missions fork",
            doc=describe.of_status(status),
            rank=i if status in free else _UNLIKELY + i,
            judged=True,
        )


def _free(hole: Hole, known: Known) -> list[Status]:
    """Return the statuses that can pass along the last arrow, and that no other one takes."""
    guard = hole.types.index("WHEN") if "WHEN" in hole.types else len(hole.types)
    stops = hole.before[:guard]
    arrow = _last_arrow(stops)
    sources, targets = _stop(stops[:arrow]), _stop(stops[arrow + 1 :])
    leaving = frozenset().union(*(known.leaves(s) - known.taken_from(s) for s in sources))
    accepted = frozenset(IN_GRAPH).intersection(*map(known.accepts, targets))
    return [status for status in IN_GRAPH if status in leaving & accepted]


def _last_arrow(tokens: Sequence[Token]) -> int:
    return max((i for i, token in enumerate(tokens) if token.type == ARROW), default=0)


def _stop(tokens: Sequence[Token]) -> list[str]:
    """Return the names of the last stop of some tokens."""
    after = [i + 1 for i, token in enumerate(tokens) if token.type == ARROW]
    return [str(token) for token in tokens[max(after, default=0) :] if token.type == NAME]
