"""The graph of an app: blocks and edges, with all names resolved and all values in SI units."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from plutoc.block import IN_GRAPH, AnyParam, Block, Given, HookKind, HookParam, Param
from plutoc.source import Source, Span
from plutoc_runtime.domain.fields import Entity
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status

START = "start"
END = "end"

FIRST_VERSION = "0.1.0"
"""The version of an app that names none."""

Plain = bool | int | float | str


@dataclass(frozen=True, slots=True, kw_only=True)
class Library:
    """What must be installed beside an app, since its hooks import it."""

    name: str
    """As installers compare names: `PyYAML` is `pyyaml`."""
    requirement: str
    """As written: `numpy>=2`."""
    direct: bool
    """It is named by its address: `numpy @ https://…`."""
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """A parameter of an action or a hook; without a default it must be given."""

    name: str
    type: Type
    default: Plain | None


@dataclass(frozen=True, slots=True, kw_only=True)
class AppField:
    """A field of missions or trips that the app declares; without a default it must be filled in."""

    on: Entity
    name: str
    type: Type
    default: Plain | None
    declaration: str
    """`dose: mass = 50 mg`: canonical, texts left out."""
    span: Span
    """Its name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Action:
    """An action of the app's own: a hook that a drone does at the end of a trip."""

    name: str
    parameters: tuple[Parameter, ...]
    returns: str | None
    """The type of what it gives: one of parameters, or `photo`; None: the app does not say."""
    repeat: str
    """`safe`, `once` or `ask`: may it be repeated after a crash?"""
    along: bool = False
    """It is done on the way, from the launch to the last leg's end."""
    takes: float | str | None
    """The seconds that plans reckon with, or the parameter that says so; None: the app does not say."""
    declaration: str
    """`action spray(dose: mass = 50 mg) -> float once takes 20 s`: canonical, on one line, texts left out."""
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """What can happen in an app: declared, or built in."""

    name: str
    fields: tuple[Parameter, ...] = ()
    declaration: str = ""
    """`event intruder(kind: text)`: canonical, on one line, texts left out; empty: it is built in."""
    span: Span | None = None
    """Its name, where it is declared."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """What the results of an action are, and how they are shown."""

    action: str
    way: str
    """One of `WAYS` of graph/results.py."""
    type: Type | None
    """The type of the number that an action of the app's own gives, or None."""
    given: tuple[tuple[str, Plain], ...]
    """What is said of them, by name: `quantity`, `unit`, `label`, `low`, `high`, `reach` in metres."""
    declaration: str
    """`result listen as values(low: 5)`: canonical, texts left out; empty: the app does not say."""
    span: Span
    """The whole statement, or the action's name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Hook:
    """An evaluator, a modifier, a policy or a creator of the app."""

    kind: HookKind
    name: str
    parameters: tuple[Parameter, ...]
    emits: tuple[Status, ...]
    """Declared statuses, in the order of `IN_GRAPH`; empty: the status stays as it was."""
    writes: tuple[str, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Category:
    """What drones of one shape can carry and do. SI units."""

    name: str
    payload: float
    speed: float
    flight_time: float
    charge_time: float
    reserve: float
    actions: tuple[str, ...] | None
    """In the order written; None: every action there is."""
    declaration: str
    """`category scout can measure`: canonical, on one line; empty where there is none."""
    span: Span | None
    """Its name; None where the source declares no category."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Choose:
    """A `Choice` parameter's value: the option's name, or the hook's."""

    name: str
    hook: Hook | None
    is_given: bool = True
    """Whether the source says so, and not the declaration's default."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A block of the app."""

    name: str
    block: Block
    package: str
    """The entry point that it comes from; ours is `std`."""
    values: tuple[tuple[str, Plain | None], ...]
    """Every `Param` of the declaration with its value, given or default, in declared order."""
    choices: tuple[tuple[str, Choose], ...]
    hook: Hook | None
    passed: tuple[tuple[str, Plain], ...]
    """The hook's own parameters, given or default, in the hook's order."""
    event: str | None = None
    """The event that it waits for."""
    declaration: str
    """`timer = TimerMonitor(default: 5 min)`: canonical, on one line, texts left out."""
    span: Span
    name_span: Span

    def emitted(self, status: Status) -> frozenset[Status]:
        """The statuses that it can emit after it took this one."""
        out = self.block.transitions.get(status) or self.block.guarded.get(status) or frozenset()
        if out and self.block.emits_by_hook and self.hook and self.hook.emits:
            out = frozenset(self.hook.emits)
        for narrowed in self.block.narrowed:
            if dict(self.values).get(narrowed.param) == narrowed.value:
                out &= narrowed.emits
        return out

    @property
    def instead(self) -> Given | None:
        """The functions that stand for the block's own, as a parameter is given."""
        values = dict(self.values)
        return next((one for one in self.block.given if values.get(one.param) is not None), None)

    @property
    def step(self) -> Callable[..., Any]:
        """The function that the flow calls."""
        return self.instead.step if self.instead else self.block.step

    @property
    def limit(self) -> Callable[..., Any] | None:
        """What it adds to a wait for the end of the trip."""
        return self.instead.limit if self.instead else self.block.limit

    @property
    def handed(self) -> Iterator[AnyParam]:
        """The parameters that its step gets."""
        values = dict(self.values)
        free = {one.param for one in self.block.given}
        for param in self.block.params:
            left = isinstance(param, Param) and param.name in free and values[param.name] is None
            if not left and not (isinstance(param, HookParam) and not param.handed):
                yield param

    @property
    def asks(self) -> bool:
        """Whether its step gets what a user wrote: in the source, in the missions file."""
        return bool(self.block.needs or self.block.uses) or any(True for _ in self.handed)

    @property
    def emits(self) -> frozenset[Status]:
        """The statuses that it can emit at all."""
        return frozenset().union(*map(self.emitted, IN_GRAPH))


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """An arrow from a block to a block, or from a source, or to `end`."""

    source: str
    target: str
    takes: frozenset[Status]
    """The guard's statuses; without one, what the target accepts; for `otherwise`, the rest."""
    guard: tuple[Status, ...] | None
    otherwise: bool
    span: Span
    """The two names and the arrow; for a guarded edge the guard is in `guard_span`."""
    guard_span: Span | None


@dataclass(frozen=True, kw_only=True)
class Graph:
    """An app: its words and its blocks, in the order of the source."""

    source: Source
    name: str
    name_span: Span
    title: str
    categories: tuple[Category, ...]
    """Never empty: an app without a category has one that can do everything."""
    fields: tuple[AppField, ...] = ()
    """Of the app's own: missions' before trips', in the order of the source."""
    events: tuple[Event, ...] = ()
    """Those that the app declares, in the order of the source."""
    actions: tuple[Action, ...]
    along: tuple[str, ...] = ()
    """The actions that can be done on the way, built-in ones among them, in the order of the source."""
    results: tuple[Shown, ...] = ()
    """What the app says of results, in the order of the source; then what its own actions say."""
    hooks: tuple[Hook, ...]
    nodes: tuple[Node, ...]
    edges: tuple[Edge, ...]
    version: str = FIRST_VERSION
    """As PEP 440 writes it: of `1.2.0-beta`, `1.2.0b0`."""
    version_span: Span | None = None
    """None where the source names none."""
    libraries: tuple[Library, ...] = ()
    kinds: tuple[Block, ...] = ()
    """What can be declared without a package's prefix: a check can say which one is missing."""

    @cached_property
    def node(self) -> dict[str, Node]:
        """The blocks by name."""
        return {node.name: node for node in self.nodes}

    @cached_property
    def sources(self) -> tuple[str, ...]:
        """Where missions come from: `start`, and the events that lead somewhere, in that order."""
        known = {START: None, **{event.name: None for event in self.events}}
        drawn = {edge.source: None for edge in self.edges if edge.source not in self.node}
        return tuple(name for name in known | drawn if name in drawn or name == START)

    @cached_property
    def reacts(self) -> bool:
        """Whether anything here has to do with events."""
        return bool(self.events or len(self.sources) > 1 or any(n.event for n in self.nodes))

    @cached_property
    def follows(self) -> bool:
        """Whether its drones can follow what moves: they are said to, or can do all, and it has events."""
        return any(
            bool(self.events) if category.actions is None else "follow" in category.actions
            for category in self.categories
        )

    @cached_property
    def outgoing(self) -> dict[str, tuple[Edge, ...]]:
        """The edges that leave each block, and each source."""
        by_source: dict[str, list[Edge]] = {name: [] for name in (*self.sources, *self.node)}
        for edge in self.edges:
            by_source[edge.source].append(edge)
        return {name: tuple(edges) for name, edges in by_source.items()}

    @cached_property
    def incoming(self) -> dict[str, tuple[Edge, ...]]:
        """The edges that reach each block, and `end`."""
        by_target: dict[str, list[Edge]] = {name: [] for name in (*self.node, END)}
        for edge in self.edges:
            by_target[edge.target].append(edge)
        return {name: tuple(edges) for name, edges in by_target.items()}
