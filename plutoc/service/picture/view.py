"""An app as an editor shows it: blocks with their places, edges with their statuses, problems; plain data."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product

from plutoc.block import IN_GRAPH, Block
from plutoc.diagnostic import Diagnostic
from plutoc.graph.built_in import EVENTS
from plutoc.graph.categories import PARAMS
from plutoc.graph.model import END, START, Action, Edge, Hook, Node
from plutoc.hooks.module import Definition
from plutoc.hooks.module import read as read_hooks
from plutoc.hooks.python import Unreadable
from plutoc.report.block_page import first_line
from plutoc.report.layout import Positions, laid_out
from plutoc.service.document import Document
from plutoc.service.picture.arguments import argument, arguments_of, parameter_of
from plutoc.service.symbols import Occurrence, Role, fields_of
from plutoc.source import Source, Span
from plutoc.syntax.tree import (
    ActionDecl,
    BadStatement,
    BlockDecl,
    CategoryDecl,
    FlowDecl,
    Guard,
    HookDecl,
)
from plutoc_runtime.domain.status import Status

Data = dict[str, object]
Offset = Callable[[int], int]
"""Makes of an offset in the text one that the client counts."""


@dataclass(frozen=True, slots=True)
class _Way:
    """One arrow as written, between two ends that are there."""

    source: str
    target: str
    guard: Guard | None
    span: Span
    edge: Edge | None
    """None where an end is not understood."""


def view(
    document: Document,
    positions: Positions,
    *,
    hooks: Source | None = None,
    offset: Offset = lambda at: at,
    hooks_offset: Offset = lambda at: at,
) -> Data:
    """Return the whole picture of a document; `hooks` is its hooks.py, as its lines are read."""
    return _View(document, positions, hooks, offset, hooks_offset).data()


@dataclass(frozen=True)
class _View:
    document: Document
    positions: Positions
    hooks: Source | None
    offset: Offset
    hooks_offset: Offset

    def data(self) -> Data:
        document = self.document
        names = list(self.declared)
        ways = [(way.source, way.target) for way in self.ways]
        implicit = list(self._implicit())
        ways += ((name, END) for name, _ in implicit)
        spots = laid_out(names, ways, self.positions, self.events)
        bad = [s for s in document.file.app.statements if isinstance(s, BadStatement)]
        return {
            "app": document.graph.name,
            "title": document.graph.title,
            "blocks": [self._block(one, spots[name]) for name, one in self.declared.items()],
            "ends": {"start": list(spots[START]), "end": list(spots[END])},
            "events": [self._event(name, spots[name]) for name in self.events],
            "edges": [*map(self._edge, self.ways), *(self._implied(*one) for one in implicit)],
            "fields": list(self._fields()),
            "hooks": list(self._hooks()),
            "categories": list(self._categories()),
            "problems": [
                self._problem(one, names)
                for one, names in zip(document.diagnostics, self._marked, strict=True)
            ],
            "unreadable": [self._at(one.span) for one in (*document.file.bad, *bad)],
        }

    @cached_property
    def declared(self) -> dict[str, BlockDecl]:
        """The blocks as written, also those of a kind that there is not; the first of a name counts."""
        found: dict[str, BlockDecl] = {}
        for statement in self.document.file.app.statements:
            if isinstance(statement, BlockDecl) and statement.name.text not in (START, END):
                found.setdefault(statement.name.text, statement)
        return found

    @cached_property
    def events(self) -> tuple[str, ...]:
        """The events that lead somewhere, or that the app declares, in the order of the source."""
        graph = self.document.graph
        own = [event.name for event in graph.events]
        found = dict.fromkeys([*own, *graph.sources[1:]])
        return tuple(name for name in found if name not in self.declared)

    def _event(self, name: str, spot: Sequence[int]) -> Data:
        declared = next((e for e in self.document.graph.events if e.name == name), None)
        return {
            "name": name,
            "doc": EVENTS.get(name, ""),
            "text": declared.declaration if declared else "",
            "x": spot[0],
            "y": spot[1],
            "moved": name in self.positions,
            "line": self._line(declared.span.start) if declared and declared.span else None,
        }

    @cached_property
    def ways(self) -> list[_Way]:
        """The arrows as written; a name that nothing declares has no place in a picture."""
        edges = {(e.span, e.source, e.target): e for e in self.document.graph.edges}
        found = []
        for flow in self.document.file.app.statements:
            if not isinstance(flow, FlowDecl):
                continue
            last = len(flow.stops) - 2
            for i, (left, right) in enumerate(pairwise(flow.stops)):
                for source, target in product(left.names, right.names):
                    ends, span = (source.text, target.text), source.span.to(target.span)
                    if self._is_there(ends[0], START) and self._is_there(ends[1], END):
                        guard = flow.guard if i == last else None
                        edge = edges.get((span, *ends))
                        found.append(_Way(*ends, guard, span, edge))
        return found

    def _is_there(self, name: str, terminal: str) -> bool:
        event = terminal == START and name in self.events
        return name == terminal or event or name in self.declared

    def _at(self, span: Span) -> Data:
        return {"from": self.offset(span.start), "to": self.offset(span.end)}

    def _line(self, at: int) -> int:
        return self.document.source.position(at)[0]

    def _block(self, declared: BlockDecl, spot: Sequence[int]) -> Data:
        name = declared.name.text
        node = self.document.graph.node.get(name)
        block = node.block if node else None
        return {
            "name": name,
            "kind": declared.kind.text,
            "package": _package(declared, node),
            "doc": first_line(block) if block else "",
            "gate": block is not None and block.gate is not None,
            "known": block is not None,
            "x": spot[0],
            "y": spot[1],
            "moved": name in self.positions,
            "line": self._line(declared.span.start),
            **self._at(declared.span),
            "accepts": _listed(block.accepts) if block else [],
            "accepts_by_guard": _listed(block.accepts_by_guard) if block else [],
            "emits": _listed(node.emits) if node else [],
            "arguments": arguments_of(declared, node, self.document),
            "hook": node.hook.name if node and node.hook else None,
            "problems": [i for i, names in enumerate(self._marked) if name in names],
        }

    def _edge(self, way: _Way) -> Data:
        document, edge = self.document, way.edge
        statuses = document.carries.get(edge) if edge is not None else None
        guard = way.guard
        end = guard.span.end if guard else way.span.end
        return {
            "source": way.source,
            "target": way.target,
            "when": [status.text for status in guard.statuses] if guard else [],
            "otherwise": guard is not None and guard.otherwise,
            "statuses": _listed(statuses or ()),
            "known": statuses is not None,
            "fork": edge is not None and edge in self._branches,
            "implicit": False,
            **self._at(Span(way.span.start, end)),
            "problems": [
                i
                for i, one in enumerate(document.diagnostics)
                if one.source == document.source and _within(one.span, Span(way.span.start, end))
            ],
        }

    @cached_property
    def _branches(self) -> set[Edge]:
        checked = self.document.checked
        return {e for fork in checked.forks for e in fork.branches} if checked else set()

    def _implicit(self) -> Iterator[tuple[str, list[str]]]:
        """Yield where missions end without an edge to `end`."""
        left: dict[str, set[Status]] = {}
        for name, status in self.document.checked.implicit_ends if self.document.checked else ():
            left.setdefault(name, set()).add(status)
        yield from ((name, _listed(left[name])) for name in self.declared if name in left)

    def _implied(self, source: str, statuses: list[str]) -> Data:
        return {
            "source": source,
            "target": END,
            "when": [],
            "otherwise": False,
            "statuses": statuses,
            "known": True,
            "fork": False,
            "implicit": True,
            "from": None,
            "to": None,
            "problems": [],
        }

    def _fields(self) -> Iterator[Data]:
        """Yield the fields of the app's own, as written; each is called `mission.patient`."""
        for statement in fields_of(self.document.file):
            for field in statement.fields:
                yield {
                    "name": f"{statement.on}.{field.name.text}",
                    "on": statement.on,
                    "text": self.document.source.quote(field.span),
                    "type": field.type.text,
                    "required": field.default is None,
                    "line": self._line(field.span.start),
                    **self._at(field.span),
                }

    def _hooks(self) -> Iterator[Data]:
        """Yield the declarations of code of the developer's own, as written."""
        graph, there = self.document.graph, self._defined
        own: tuple[Hook | Action, ...] = (*graph.hooks, *graph.actions)
        known = {one.name: one for one in own}
        for statement in self.document.file.app.statements:
            if not isinstance(statement, HookDecl | ActionDecl):
                continue
            name = statement.name.text
            hook, definition = known.get(name), there.get(name)
            yield {
                "name": name,
                "kind": statement.kind if isinstance(statement, HookDecl) else Role.ACTION.value,
                "text": self.document.source.quote(statement.span),
                "parameters": [parameter_of(one) for one in hook.parameters] if hook else [],
                "defined": name in there,
                "line": self._line(statement.span.start),
                **self._at(statement.span),
                "hooks_line": definition.lineno if definition is not None else None,
            }

    @cached_property
    def _defined(self) -> Mapping[str, Definition]:
        try:
            return read_hooks(self.hooks).defined if self.hooks else {}
        except Unreadable:  # which is told
            return {}

    def _categories(self) -> Iterator[Data]:
        source = self.document.source
        for statement in self.document.file.app.statements:
            if isinstance(statement, CategoryDecl):
                written = {a.name.text: source.quote(a.value.span) for a in statement.arguments}
                yield {
                    "name": statement.name.text,
                    "text": source.quote(statement.span),
                    "arguments": [argument(param, written.get(param.name)) for param in PARAMS],
                    "can": [name.text for name in statement.can],
                    "line": self._line(statement.span.start),
                    **self._at(statement.span),
                }

    @cached_property
    def _marked(self) -> list[list[str]]:
        """Which blocks each problem has to do with."""
        return [list(self._blocks_of(one)) for one in self.document.diagnostics]

    def _blocks_of(self, found: Diagnostic) -> Iterator[str]:
        names = [name for name, _ in found.path]
        if found.source == self.document.source:
            for name, declared in self.declared.items():
                if _within(found.span, declared.span):
                    names.append(name)
            names += [one.name for one in self._block_names if _within(one.span, found.span)]
        yield from (name for name in dict.fromkeys(names) if name in self.declared)

    @cached_property
    def _block_names(self) -> list[Occurrence]:
        return [one for one in self.document.names if one.role is Role.BLOCK]

    def _problem(self, found: Diagnostic, blocks: Sequence[str]) -> Data:
        return {
            "code": found.code,
            "severity": found.severity.value,
            "message": found.message,
            "help": found.help,
            "label": found.label,
            "file": self._file_of(found.source),
            **self._place(found.source, found.span),
            "line": found.source.position(found.span.start)[0],
            "blocks": list(blocks),
            "path": [list(one) for one in found.path],
            "fix": found.fix is not None,
            "related": [
                {
                    "file": self._file_of(one.source),
                    **self._place(one.source, one.span),
                    "label": one.label,
                }
                for one in found.related
            ],
        }

    def _file_of(self, source: Source) -> str:
        return "app" if source == self.document.source else "hooks"

    def _place(self, source: Source, span: Span) -> Data:
        to = self.offset if source == self.document.source else self.hooks_offset
        return {"from": to(span.start), "to": to(span.end)}


def _package(declared: BlockDecl, node: Node | None) -> str:
    if node is not None:
        return node.package
    return declared.prefix.text if declared.prefix else ""


def kind_of(block: Block) -> Data:
    """Return which statuses a kind of block takes and gives."""
    given = (*block.transitions.values(), *block.guarded.values())
    return {
        "accepts": _listed(block.accepts),
        "accepts_by_guard": _listed(block.accepts_by_guard),
        "emits": _listed({status for one in given for status in one}),
    }


def _listed(statuses: object) -> list[str]:
    assert isinstance(statuses, frozenset | set | tuple)
    return [status.value for status in IN_GRAPH if status in statuses]


def _within(inner: Span, outer: Span) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end
