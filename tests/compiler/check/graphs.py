"""Graphs for tests, from a few lines of text, without the parser.

`watch = TripMonitor` declares a block, `retry = PriorityManager(max_attempts: 0)` sets a value,
`mark = MissionModifier emits STANDBY writes note` gives it a hook, `(hook: chase)` a creator, and
`(event: smoke)` an event; `action look along` declares an action; the rest are edges.
"""

from __future__ import annotations

import itertools
import re
from pathlib import Path

from plutoc.block import IN_GRAPH, Block, HookKind, Param
from plutoc.check.model import Checked
from plutoc.check.run import check
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.graph.model import END, START, Action, Edge, Graph, Hook, Node
from plutoc.source import Source, Span
from plutoc_blocks import BLOCKS
from plutoc_runtime.domain.status import Status
from tests.kit.sections import given

KINDS: dict[str, Block] = {block.name: block for block in BLOCKS}

BLOCK = re.compile(
    r"(\w+) = (\w+)(?:\((\w+): (\w+)\))?(?: emits ([A-Z, ]+))?(?: writes ([a-z, ]+))?"
)
ALONG = re.compile(r"action (\w+) along")
FLOW = re.compile(r"(.*?)(?: (?:when ([A-Z, ]+)|(otherwise)))?")
ENDS = frozenset({Status.COMPLETED, Status.FAILED})

BASIC = """
    create = MissionCreator
    allocate = DroneAllocator
    launch = TripLauncher
    watch = TripMonitor
"""
GATED = f"""{BASIC}
    timer = TimerMonitor
    first = GateFIFO
    start -> create -> allocate -> launch -> [watch, timer] -> first
"""
SOUND = given(Path(__file__).parent / "cases/sound.txt")
"""Graphs that must pass: the thesis's, and shapes that look like mistakes but are none."""
ALFALFA = SOUND["alfalfa"]


def build(text: str, title: str = "") -> Graph:
    """Return the graph of a text."""
    source = Source(path="app.pluto", text=text)
    nodes: dict[str, Node] = {}
    raw: list[tuple[str, str, tuple[Status, ...] | None, bool, Span]] = []
    actions: list[Action] = []
    offset = 0
    for line in text.splitlines(keepends=True):
        span = Span(offset + len(line) - len(line.lstrip()), offset + len(line.rstrip()))
        offset += len(line)
        if match := BLOCK.fullmatch(line.strip()):
            nodes[match[1]] = _node(match, span)
        elif match := ALONG.fullmatch(line.strip()):
            actions.append(_along(match[1], span))
        elif line.strip():
            raw.extend(_arrows(line.strip(), span))
    edges: list[Edge] = []
    for one, target, guard, otherwise, span in raw:
        accepts = ENDS if target == END else nodes[target].block.accepts
        # what a guard names beyond that is refused before the checks
        allowed = ENDS if target == END else nodes[target].block.accepts_by_guard
        rest = otherwise or (target == END and guard is None)
        takes = frozenset(guard) & allowed if guard is not None else accepts
        if rest:
            others = [r for r in raw if r[0] == one and r[1:] != (target, guard, otherwise, span)]
            for _, to, names, _, _ in others:
                takes -= frozenset(names) if names else _accepted(nodes, to)
        edges.append(
            Edge(
                source=one,
                target=target,
                takes=takes,
                guard=guard,
                otherwise=rest,
                span=span,
                guard_span=None,
            )
        )
    return Graph(
        source=source,
        name="app",
        name_span=Span(0, 0),
        title=title,
        categories=(),
        actions=tuple(actions),
        along=tuple(action.name for action in actions),
        hooks=tuple(node.hook for node in nodes.values() if node.hook),
        nodes=tuple(nodes.values()),
        edges=tuple(edges),
        kinds=BLOCKS,
    )


def checked(text: str) -> Checked:
    """Return a sound graph, checked."""
    return check(build(text))[0]


def findings(text: str) -> list[Diagnostic]:
    """Return everything that the checks say."""
    try:
        return list(check(build(text))[1])
    except Rejected as rejected:
        return list(rejected.diagnostics)


def _accepted(nodes: dict[str, Node], name: str) -> frozenset[Status]:
    return frozenset() if name == END else nodes[name].block.accepts


def _node(match: re.Match[str], span: Span) -> Node:
    block = KINDS[match[2]]
    name_span = Span(span.start, span.start + len(match[1]))
    values = {p.name: p.default for p in block.params if isinstance(p, Param)}
    if match[4] and match[4].isdecimal():
        values[match[3]] = int(match[4])
    hook = _creator(match[4], span) if match[3] == "hook" else None
    if match[5] or match[6]:
        hook = Hook(
            kind=HookKind.MODIFIER,
            name=f"{match[1]}_hook",
            parameters=(),
            emits=tuple(s for s in IN_GRAPH if s.value in (match[5] or "")),
            writes=tuple((match[6] or "").replace(",", "").split()),
            span=name_span,
        )
    return Node(
        name=match[1],
        block=block,
        package="std",
        values=tuple(values.items()),
        choices=(),
        hook=hook,
        passed=(),
        event=match[4] if match[3] == "event" else None,
        declaration=match[0],
        span=span,
        name_span=name_span,
    )


def _creator(name: str, span: Span) -> Hook:
    return Hook(kind=HookKind.CREATOR, name=name, parameters=(), emits=(), writes=(), span=span)


def _along(name: str, span: Span) -> Action:
    return Action(
        name=name,
        parameters=(),
        returns=None,
        repeat="safe",
        along=True,
        takes=None,
        declaration=f"action {name} along",
        span=span,
    )


def _arrows(line: str, span: Span) -> list[tuple[str, str, tuple[Status, ...] | None, bool, Span]]:
    match = FLOW.fullmatch(line)
    assert match
    stops = [[n.strip() for n in stop.strip(" []").split(",")] for stop in match[1].split("->")]
    guard = tuple(Status(name.strip()) for name in match[2].split(",")) if match[2] else None
    found: list[tuple[str, str, tuple[Status, ...] | None, bool, Span]] = []
    for index, (ones, targets) in enumerate(itertools.pairwise(stops)):
        last = index == len(stops) - 2
        for one in ones:
            for target in targets:
                assert one == START or target != START
                # each arrow gets a place of its own, as in a real source
                place = Span(span.start + len(found), span.end)
                found.append((one, target, guard if last else None, last and bool(match[3]), place))
    return found
