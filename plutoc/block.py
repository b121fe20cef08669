"""What a block is: the vocabulary in which every block, ours or yours, is declared.

A declaration is plain data. The compiler reads it and never asks for a block by name: checks, plan,
generated code, pages and screens all come from these properties.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from types import MappingProxyType
from typing import Any

from plutoc_runtime.domain.fields import Field
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import (
    COMPLETED,
    FAILED,
    RUNNING,
    STANDBY,
    UNEXECUTED,
    Status,
)

IN_GRAPH = (UNEXECUTED, RUNNING, STANDBY, COMPLETED, FAILED)
"""The statuses that edges carry, in declared order."""

Transitions = Mapping[Status, frozenset[Status]]
"""For each status that a block accepts, the statuses that it can then emit."""


def emits(*statuses: Status) -> frozenset[Status]:
    """Return the statuses as a set."""
    return frozenset(statuses)


def same(*statuses: Status) -> Transitions:
    """A block that hands each of these statuses on as it came."""
    return MappingProxyType({status: frozenset((status,)) for status in statuses})


ANY_SAME = same(*IN_GRAPH)


class HookKind(Enum):
    """The five kinds of code that a developer adds."""

    ACTION = "action"
    EVALUATOR = "evaluator"
    MODIFIER = "modifier"
    POLICY = "policy"
    CREATOR = "creator"


class Gate(Enum):
    """How a block closes a fork."""

    FIRST = "the first branch to arrive passes, the others are cancelled"
    ALL = "waits for every branch, then passes the worst status"


@dataclass(frozen=True, slots=True, kw_only=True)
class Param:
    """A value written in the source, in parentheses after the block's kind."""

    name: str
    type: Type
    doc: str
    default: bool | int | float | str | None = None
    """In SI units. None: the block does without."""
    required: bool = False
    least: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class HookParam:
    """The name of a hook. The block's step gets the function itself, as `hook`."""

    name: str
    kind: HookKind
    doc: str
    required: bool = True
    handed: bool = True
    """Its step gets it. If not, the app's description has it: it is called before a mission is there."""
    passes: bool = False
    """The hook's own parameters are written beside it, and its step gets them by name."""
    instead: str = ""
    """The field by which a mission chooses another of the app's hooks of this kind, if there is one.

    What is written beside the hook is for that hook alone: a block for which something is gets the
    hook's name, too, as `own`. Another hook takes its defaults.
    """


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Choice:
    """One of several functions of the runtime, by name, or one of the app's hooks."""

    name: str
    options: Mapping[str, Callable[..., Any]]
    default: str
    doc: str
    hook: HookKind | None = None
    adapt: Callable[..., Any] | None = None
    """Makes of the app's hook what the options are."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EventParam:
    """The name of an event: one of the app's own, or a built-in one. It must be given."""

    name: str
    doc: str
    required: bool = True


AnyParam = Param | HookParam | Choice | EventParam


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Given:
    """Where a parameter is given, these functions stand for the block's own, and get it by name.

    So an app that does not use it carries nothing of it.
    """

    param: str
    step: Callable[..., Any]
    limit: Callable[..., Any] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Narrowed:
    """While a parameter has this value, the block emits no more than these statuses."""

    param: str
    value: bool | int | float | str
    emits: frozenset[Status]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Block:
    """One kind of block.

    `step` is the function of the runtime itself, not its name: a type checker follows it, an editor
    jumps to it, and the compiler finds from it the module to carry along. It is called as
    `step(run, status, **parameters, **fields)` and gives the status that the mission leaves with; a
    gate's as `step(run, status, *branches)`. It may be a coroutine function,
    or a generator that `types.coroutine` makes one.
    """

    name: str
    doc: str
    """The first line is a sentence that a user understands. Sources: the thesis's sections."""
    step: Callable[..., Any]
    transitions: Transitions
    guarded: Transitions = field(default_factory=dict)
    """Accepted only where an edge's guard says so."""
    params: tuple[AnyParam, ...] = ()
    given: tuple[Given, ...] = ()
    """Of parameters without a default, those for which there are other functions."""
    narrowed: tuple[Narrowed, ...] = ()
    emits_by_hook: bool = False
    """Where its hook declares `emits`, it emits exactly those."""
    needs: tuple[Field, ...] = ()
    """Fields that exist because this block is in the graph; its step gets their values by name."""
    reads: tuple[str, ...] = ()
    """Those of them that its step asks the mission or the trip for itself, and gets not by name."""
    uses: tuple[str, ...] = ()
    """Fields that its step gets too, where another block brings them in."""
    named: bool = False
    """Its step gets the block's own name in the graph, as `block`.

    A block that holds or allocates must be so: an interrupted mission may go on there, and its step
    begins by saying so, `run.meets(block)`.
    """

    creates: bool = False
    """Missions begin here: those of the user behind `start`, and those that a hook makes of an event."""
    holds: bool = False
    """A mission may rest here for a time that the user chose."""
    allocates: bool = False
    """Gives the mission a drone."""
    launches: bool = False
    """Starts the next trip with the drone that was allocated."""
    watches: bool = False
    """Ends with the outcome of the trip in flight, and does nothing else before."""
    limits: bool = False
    """Watches, and ends the flight itself; goes beside a block that only watches."""
    interrupts: bool = False
    """It limits a flight by an event, which ends no trip: that waits again, as if it had not flown."""
    limit: Callable[..., Any] | None = None
    """What it adds to a wait for the end of the trip, so that one wait can stand for several blocks.

    Called as `limit(run, **parameters, **fields)`, it gives a `plutoc_runtime.flow.flight.Limit`, or None
    for no limit. The block's step must do no more than to wait under that limit.
    """
    evaluates: bool = False
    """Judges a finished mission and may ask for more trips."""
    repeats: bool = False
    """Starts a finished mission once more."""
    retries: bool = False
    """Puts a failed trip back."""
    skips: bool = False
    """Leaves a failed trip out."""
    bound: str | None = None
    """The parameter that bounds how often it does so; 0 is no bound."""
    gate: Gate | None = None

    @property
    def accepts(self) -> frozenset[Status]:
        """The statuses it takes without a guard."""
        return frozenset(self.transitions)

    @property
    def accepts_by_guard(self) -> frozenset[Status]:
        """The statuses it takes when a guard names them."""
        return frozenset(self.transitions) | frozenset(self.guarded)

    @property
    def needs_trip(self) -> bool:
        """Whether a mission that comes with no trip left to fly ends there, FAILED."""
        return self.allocates or self.retries or self.skips

    def param(self, name: str) -> AnyParam | None:
        """Return the parameter of that name."""
        return next((param for param in self.params if param.name == name), None)
