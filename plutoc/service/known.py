"""What there is to choose from in an app: its names, those that it still lacks, kinds, hooks, units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from plutoc.block import IN_GRAPH, AnyParam, Block, Choice, HookKind, HookParam
from plutoc.graph.built_in import ACTIONS, EVENTS
from plutoc.graph.model import START, Action, Graph, Hook, Parameter
from plutoc.graph.names import in_snake_case, reserved
from plutoc.graph.stops import accepts_by_guard
from plutoc.registry import STD, Blocks, RegistryError
from plutoc.service.symbols import DECLARED, Occurrence, Role
from plutoc.source import Source
from plutoc.syntax.tree import BlockDecl, Bool, File, Name
from plutoc_runtime.domain.actions import BUILT_IN
from plutoc_runtime.domain.status import Status


@dataclass(frozen=True, kw_only=True)
class Known:
    """What a part of an app declares and uses."""

    file: File
    graph: Graph
    names: tuple[Occurrence, ...]
    installed: Blocks

    @cached_property
    def declared(self) -> dict[str, Role]:
        """What is declared, by name."""
        found: dict[str, Role] = {}
        for one in self.names:
            if one.declares and one.role in DECLARED:
                found.setdefault(one.name, one.role)
        return found

    @cached_property
    def taken(self) -> frozenset[str]:
        """The names that nothing new can have, in small letters."""
        return frozenset(name.lower() for name in (*self.declared, *ACTIONS))

    @cached_property
    def prefixes(self) -> dict[str, str]:
        """The packages that are used, by prefix."""
        return {(use.alias or use.package).text: use.package.text for use in self.file.uses}

    def kinds_of(self, package: str) -> Mapping[str, Block]:
        """Return the kinds of a package; none of one that is broken, which is told elsewhere."""
        try:
            return self.installed.of(package)
        except RegistryError:
            return {}

    @cached_property
    def kinds(self) -> dict[str, Block]:
        """Every kind, as an app writes it."""
        found = dict(self.kinds_of(STD))
        for prefix, package in self.prefixes.items():
            if package in self.installed.packages:
                found |= {f"{prefix}.{kind}": b for kind, b in self.kinds_of(package).items()}
        return found

    def kind_of(self, block: BlockDecl) -> Block | None:
        """Return the kind of a declared block, if it exists."""
        prefix = f"{block.prefix.text}." if block.prefix else ""
        return self.kinds.get(f"{prefix}{block.kind.text}")

    @cached_property
    def blocks(self) -> tuple[str, ...]:
        """The names of the blocks."""
        return tuple(name for name, role in self.declared.items() if role is Role.BLOCK)

    def hooks(self, kind: HookKind) -> tuple[str, ...]:
        """Return the names of the hooks of a kind, in the order of the source."""
        return tuple(name for name, role in self.declared.items() if role.value == kind.value)

    @cached_property
    def hook(self) -> dict[str, Hook | Action]:
        """The hooks by name, actions included."""
        every: tuple[Hook | Action, ...] = (*self.graph.actions, *self.graph.hooks)
        return {one.name: one for one in every}

    @property
    def actions(self) -> tuple[str, ...]:
        """What drones can do: built in, and of the app's own."""
        return (*self.hooks(HookKind.ACTION), *ACTIONS)

    @property
    def usual(self) -> tuple[str, ...]:
        """Those of them that drones of any app may well do."""
        return (*self.hooks(HookKind.ACTION), *BUILT_IN)

    @cached_property
    def events(self) -> tuple[str, ...]:
        """The events that a block can wait for: the app's own, and built in."""
        return (*(event.name for event in self.graph.events), *EVENTS)

    @cached_property
    def own_sources(self) -> tuple[str, ...]:
        """Those of them that are sure to be meant: `start`, and the app's own events."""
        return (START, *(event.name for event in self.graph.events))

    @cached_property
    def sources(self) -> tuple[str, ...]:
        """What an arrow can begin at that is no block."""
        return (START, *(event for event in self.events if event not in self.blocks))

    @cached_property
    def unused(self) -> frozenset[str]:
        """Declared names that nothing uses yet."""
        used = {one.name for one in self.names if not one.declares}
        return frozenset(self.declared.keys() - used)

    @cached_property
    def lacking(self) -> dict[Role, tuple[str, ...]]:
        """The names that are used and not declared, by what each must be."""
        found: dict[Role, dict[str, None]] = {}
        for role, name in self._wanted():
            if name not in self.declared and name not in ACTIONS and not reserved(name):
                found.setdefault(role, {})[name] = None
        return {role: tuple(names) for role, names in found.items()}

    def _wanted(self) -> Iterator[tuple[Role, str]]:
        for one in self.names:
            if one.role in _USED and not one.declares and one.name not in EVENTS:
                yield one.role, one.name
        for statement in self.file.app.statements:
            if isinstance(statement, BlockDecl) and (kind := self.kind_of(statement)):
                for argument in statement.arguments:
                    hook = hook_of(kind.param(argument.name.text))
                    name = name_of(self.file.source, argument.value)
                    choice = kind.param(argument.name.text)
                    offered = choice.options if isinstance(choice, Choice) else ()
                    if hook and name and name not in offered:
                        yield Role(hook.value), name

    def fresh(self, name: str) -> str:
        """Return a name that is free: this one, or with a number."""
        if name not in self.taken and not reserved(name):
            return name
        return next(n for i in range(2, 100_000) if (n := f"{name}_{i}") not in self.taken)

    def names_for(self, kind: str) -> str:
        """Return a free name for a new block of a kind."""
        return self.fresh(in_snake_case(kind.rpartition(".")[2]))

    def leaves(self, name: str) -> frozenset[Status]:
        """Return the statuses with which missions can leave a block, as far as that is clear."""
        if name in self.sources:
            return frozenset({Status.UNEXECUTED})
        node = self.graph.node.get(name)
        return node.emits if node else frozenset(IN_GRAPH)

    def accepts(self, name: str) -> frozenset[Status]:
        """Return the statuses that a block takes from an arrow with a guard."""
        return accepts_by_guard(name, self.graph.node)

    def taken_from(self, name: str) -> frozenset[Status]:
        """Return the statuses that arrows of a block take already."""
        edges = self.graph.outgoing.get(name, ())
        return frozenset().union(*(edge.takes for edge in edges))

    def passed_by(self, values: Iterable[str]) -> tuple[tuple[str, Parameter], ...]:
        """Return the parameters of the hooks among some values, each with its hook."""
        hooks = (self.hook[name] for name in values if name in self.hook)
        return tuple((hook.name, one) for hook in hooks for one in hook.parameters)


_USED = (Role.BLOCK, Role.ACTION, Role.PREFIX, Role.EVENT)


def hook_of(param: AnyParam | None) -> HookKind | None:
    """Return which hook a parameter can name."""
    match param:
        case HookParam():
            return param.kind
        case Choice():
            return param.hook
    return None


def name_of(source: Source, value: object) -> str | None:
    """Return a value as a name: a hook may be called `yes`."""
    if isinstance(value, Name):
        return value.text
    return source.quote(value.span) if isinstance(value, Bool) else None
