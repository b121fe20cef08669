"""Edges, as they are written: drawn, taken out, guarded and led elsewhere."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise, product

from plutoc.diagnostic import Fix
from plutoc.graph.model import END
from plutoc.service.editing.draft import Draft
from plutoc.service.editing.operations import Arrow
from plutoc.source import Span
from plutoc.syntax.tree import File, FlowDecl, Guard, Stop

Pieces = list[Span | str]
"""A statement to be: what stands there already, and what is new."""


class CannotEdit(Exception):
    """An operation cannot be done on this text. The message is a sentence for a person."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Written:
    """One edge, where it is written."""

    flow: FlowDecl
    arrow: int
    """The arrow of its statement, from 0."""

    @property
    def is_last(self) -> bool:
        """Whether the statement's guard is the edge's."""
        return self.arrow == len(self.flow.stops) - 2

    @property
    def ends(self) -> tuple[Stop, Stop]:
        """The stops that its arrow joins."""
        return self.flow.stops[self.arrow], self.flow.stops[self.arrow + 1]

    @property
    def is_alone(self) -> bool:
        """Whether its arrow makes no other edge."""
        return all(len(stop.names) == 1 for stop in self.ends)


def arrows(file: File) -> Iterator[tuple[Arrow, FlowDecl, int]]:
    """Yield every edge that is written, its statement, and which arrow of that it is."""
    for flow in flows(file):
        for i, (left, right) in enumerate(pairwise(flow.stops)):
            guard = flow.guard if i == len(flow.stops) - 2 else None
            for source, target in product(left.names, right.names):
                yield arrow_of(source.text, target.text, guard), flow, i


def arrow_of(source: str, target: str, guard: Guard | None) -> Arrow:
    """Return an edge as an operation names it; unguarded to `end` is `otherwise`."""
    return Arrow(
        source=source,
        target=target,
        when=tuple(status.text for status in guard.statuses) if guard else (),
        otherwise=guard.otherwise if guard else target == END,
    )


def flows(file: File) -> list[FlowDecl]:
    """Return the flows of an app."""
    return [each for each in file.app.statements if isinstance(each, FlowDecl)]


def is_there(draft: Draft, arrow: Arrow) -> bool:
    """Return whether an edge is written."""
    return any(_is_same(one, arrow) for one, _, _ in arrows(draft.file))


def connected(draft: Draft, arrow: Arrow) -> Draft:
    """Draw an edge: at the end of the flow that ends at its source, else on a line of its own."""
    if is_there(draft, arrow):
        raise CannotEdit(f"the edge from `{arrow.source}` to `{arrow.target}` is there already")
    guard = guard_text(arrow)
    return extended(draft, arrow.source, f"{arrow.target}{guard}", chains=not guard)


def extended(draft: Draft, source: str, rest: str, *, chains: bool = True) -> Draft:
    """Lead edges on from a block: `rest` is what stands behind its arrow."""
    drawn = flows(draft.file)
    leaves = any(source in _names(stop) for flow in drawn for stop in flow.stops[:-1])
    tail = next((f for f in drawn if _names(f.stops[-1]) == [source] and not f.guard), None)
    if chains and tail and not leaves:
        end = tail.stops[-1].span.end
        return draft.changed(Fix(span=Span(end, end), text=f" -> {rest}"))
    return added(draft, f"{source} -> {rest}", source)


def added(draft: Draft, text: str, source: str) -> Draft:
    """Add a flow: below the last one that leaves this block, or leads there, or the last of all."""
    drawn = flows(draft.file)
    leaving = [f for f in drawn if any(source in _names(stop) for stop in f.stops[:-1])]
    reaching = [f for f in drawn if source in _names(f.stops[-1])]
    near = leaving or reaching or drawn
    if near:
        last = near[-1]
        return draft.changed(draft.behind(last.span.end, draft.indent(last) + text))
    statements = draft.file.app.statements
    if not statements:
        raise CannotEdit("there is no block yet")
    last_one = statements[-1]
    return draft.changed(draft.behind(last_one.span.end, f"\n{draft.indent(last_one)}{text}"))


def disconnected(draft: Draft, arrow: Arrow) -> Draft:
    """Take an edge out; the others of its statement stay."""
    return _instead(draft, _find(draft, arrow), arrow, None)


def guarded(draft: Draft, arrow: Arrow, new: Arrow) -> Draft:
    """Give an edge another guard."""
    written = _find(draft, arrow)
    if _is_same(arrow, new):
        return draft
    if is_there(draft, new):
        raise CannotEdit(f"there is such an edge from `{arrow.source}` to `{arrow.target}` already")
    guard = guard_text(new)
    if written.is_last and written.is_alone:
        flow = written.flow
        end = flow.guard.span.end if flow.guard else flow.stops[-1].span.end
        return draft.changed(Fix(span=Span(flow.stops[-1].span.end, end), text=guard))
    return _instead(draft, written, arrow, new)


def redirected(draft: Draft, arrow: Arrow, new: Arrow) -> Draft:
    """Lead an edge from or to another block."""
    written = _find(draft, arrow)
    if (arrow.source, arrow.target) == (new.source, new.target):
        return draft
    if is_there(draft, new):
        raise CannotEdit(f"there is such an edge from `{new.source}` to `{new.target}` already")
    source, target = written.ends
    fixes = []
    if new.source != arrow.source:
        fixes.append((source, new.source, written.arrow == 0))
    if new.target != arrow.target:
        fixes.append((target, new.target, written.is_last))
    same = guard_text(new) == guard_text(arrow)
    if same and written.is_alone and all(outer for _, _, outer in fixes):
        return draft.changed(*(Fix(span=stop.span, text=name) for stop, name, _ in fixes))
    return _instead(draft, written, arrow, new)


def bracketed(draft: Draft, source: str, targets: Sequence[str]) -> Draft:
    """Write unguarded edges from one block to several as one, and on to where all of them lead."""
    if len(set(targets)) < 2:
        raise CannotEdit("brackets stand around two blocks or more")
    for target in targets:
        draft = disconnected(draft, Arrow(source=source, target=target))
    rest = f"[{', '.join(targets)}]"
    led = [
        [arrow for arrow, _, _ in arrows(draft.file) if arrow.source == target]
        for target in targets
    ]
    if END not in targets and all(len(leads) == 1 for leads in led):
        onward = {(a.target, a.when, a.otherwise) for leads in led for a in leads}
        if len(onward) == 1 and not guard_text(led[0][0]):
            for leads in led:
                draft = disconnected(draft, leads[0])
            rest += f" -> {led[0][0].target}"
    return extended(draft, source, rest)


def without_blocks(draft: Draft, names: Collection[str]) -> Draft:
    """Take out every edge that touches these blocks."""
    for flow in reversed(flows(draft.file)):
        if any(name in names for stop in flow.stops for name in _names(stop)):
            draft = _rewritten(draft, flow, list(_parts(flow, names)))
    return draft


def among(file: File, names: Collection[str]) -> list[str]:
    """Return the flows among some blocks, as text."""
    found = []
    for flow in flows(file):
        others = {n for stop in flow.stops for n in _names(stop)} - set(names)
        for part in _parts(flow, others, whole=False):
            found.append("".join(piece for piece in part if isinstance(piece, str)))
    return found


def guard_text(arrow: Arrow) -> str:
    """Return an edge's guard as it is written; unguarded to `end` needs no word."""
    if arrow.when:
        return f" when {', '.join(arrow.when)}"
    return " otherwise" if arrow.otherwise and arrow.target != END else ""


def _names(stop: Stop) -> list[str]:
    return [name.text for name in stop.names]


def _is_same(one: Arrow, other: Arrow) -> bool:
    if (one.source, one.target, set(one.when)) != (other.source, other.target, set(other.when)):
        return False
    at_end = one.target == END and not one.when
    return at_end or one.otherwise == other.otherwise


def _find(draft: Draft, arrow: Arrow) -> _Written:
    for one, flow, i in arrows(draft.file):
        if _is_same(one, arrow):
            return _Written(flow=flow, arrow=i)
    guard = guard_text(arrow)
    raise CannotEdit(f"there is no edge from `{arrow.source}` to `{arrow.target}`{guard}")


def _instead(draft: Draft, written: _Written, arrow: Arrow, new: Arrow | None) -> Draft:
    """Put another edge, or none, in an edge's place."""
    flow, i = written.flow, written.arrow
    left, right = written.ends
    guard = _guard_of(draft, flow) if written.is_last else ""
    others = [name for name in _names(right) if name != arrow.target]
    parts: list[Pieces] = []
    if written.is_last and len(left.names) == 1 and others:
        # `launch -> [watch, timer]`: the rest stays in the brackets
        parts.append([Span(flow.span.start, right.span.start), _stop(others), guard])
    else:
        if i > 0:
            parts.append([Span(flow.span.start, left.span.end)])
        rest = [name for name in _names(left) if name != arrow.source]
        if rest:
            parts.append([f"{_stop(rest)} -> {_stop(_names(right))}{guard}"])
        if others:
            parts.append([f"{arrow.source} -> {_stop(others)}{guard}"])
    if new is not None:
        parts.append([f"{new.source} -> {new.target}{guard_text(new)}"])
    if not written.is_last:
        parts.append([Span(right.span.start, flow.span.end)])
    return _rewritten(draft, flow, parts)


def _guard_of(draft: Draft, flow: FlowDecl) -> str:
    return f" {draft.text(flow.guard.span)}" if flow.guard else ""


def _stop(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"[{', '.join(names)}]"


def _parts(flow: FlowDecl, gone: Collection[str], *, whole: bool = True) -> Iterator[Pieces]:
    """Yield what is left of a flow without some blocks: a statement for each run of stops.

    `whole`: what stays as it is keeps its layout; else all is written anew.
    """
    run: list[tuple[Stop, list[str]]] = []
    for stop in (*flow.stops, None):
        names = [name for name in _names(stop) if name not in gone] if stop else []
        if stop and names:
            run.append((stop, names))
            continue
        if len(run) > 1:
            yield _joined(flow, run, whole=whole)
        run = []


def _joined(flow: FlowDecl, run: list[tuple[Stop, list[str]]], *, whole: bool) -> Pieces:
    pieces: Pieces = []
    for before, (stop, names) in zip([None, *run], run, strict=False):
        if before:
            between = Span(before[0].span.end, stop.span.start)
            pieces.append(between if whole else " -> ")
        same = len(names) == len(stop.names)
        pieces.append(stop.span if whole and same else _stop(names))
    if flow.guard and run[-1][0] is flow.stops[-1]:
        statuses = ", ".join(name.text for name in flow.guard.statuses)
        pieces.append(f" when {statuses}" if statuses else " otherwise")
    return pieces


def _rewritten(draft: Draft, flow: FlowDecl, parts: list[Pieces]) -> Draft:
    """Put statements in the place of one; comments without a place among them come above them."""
    kept = [piece for part in parts for piece in part if isinstance(piece, Span)]
    gaps = pairwise([flow.span.start, *(at for span in kept for at in span), flow.span.end])
    lost = [
        comment
        for number, (start, end) in enumerate(gaps)
        if number % 2 == 0 and start < end
        for comment in draft.comments(Span(start, end))
    ]
    texts = ["".join(p if isinstance(p, str) else draft.text(p) for p in part) for part in parts]
    if not texts and not lost:
        return draft.changed(draft.without(flow))
    return draft.changed(draft.written(flow, "\n".join(texts), lost))
