"""The plan: what the generated coroutine does, as data that can be printed and checked.

A body is a sequence of steps. Control leaves it by falling off its end, which means what the step
around it says, or by `Continue`, `Break` or `End`.
"""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.check.model import Checked
from plutoc.graph.model import Node
from plutoc_runtime.domain.status import Status

Place = str | None
"""The block at which an interrupted mission goes on; None: it begins."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Call:
    """The mission goes through a block: `status = step(run, status, …)`."""

    node: Node


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    """One way through a fork, a function of its own; `End` in it is the arrival at the gate."""

    name: str
    """A Python name that no other function of the flow has."""
    path: str
    """`launch -> watch -> first`, for a person."""
    body: Body
    idle: bool = False
    """Without it everything is the same: no clone is sent."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Join:
    """A fork and the gate that closes it: `status = gate(run, status, branch, branch)`."""

    fork: Node
    gate: Node
    branches: tuple[Branch, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Watch:
    """One wait for the end of the trip, under all limits: `status = watch(run, limit, limit)`."""

    instead: Call | Join
    """What the graph says: a block that watches the trip, or a fork of such blocks with its gate."""
    watchers: tuple[Node, ...]
    """The blocks that would each have waited, in the order of their branches."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arm:
    """What is done for some of the statuses of a `Switch`; `to` names where it leads."""

    statuses: tuple[Status, ...]
    body: Body
    to: str
    places: tuple[Place, ...] = ()
    """In place of statuses, where an interrupted mission goes on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Switch:
    """Goes on by status, or by where a mission was interrupted. The arms share neither."""

    arms: tuple[Arm, ...]
    decided: bool = False
    """Nothing else can arrive, so the last arm takes what the others leave, without asking."""

    @property
    def enters(self) -> bool:
        """Does it ask where an interrupted mission goes on?"""
        return any(arm.places for arm in self.arms)


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrived:
    """An interrupted mission has come to where it goes on: from here it is one like any other."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Loop:
    """`while True`: falling off the end begins again."""

    head: str
    body: Body


@dataclass(frozen=True, slots=True, kw_only=True)
class Continue:
    """Begin the innermost loop again."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Break:
    """Leave the innermost loop and go on behind it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class End:
    """The mission, or the branch, is at its end: `return status`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Goto:
    """Inside a `Dispatch`: go on with the case of this name."""

    label: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One place of a `Dispatch`; its body ends with `Goto` or `End` on every way."""

    label: str
    body: Body


@dataclass(frozen=True, slots=True, kw_only=True)
class Dispatch:
    """For a graph without structure: `match` on where the mission is, in one loop."""

    start: str
    cases: tuple[Case, ...]
    entries: tuple[str, ...] = ()
    """Cases with which interrupted missions begin."""


Step = Call | Join | Watch | Switch | Arrived | Loop | Continue | Break | End | Goto | Dispatch
Body = tuple[Step, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """An app's flow."""

    checked: Checked
    body: Body
    left_out: tuple[tuple[str, str], ...] = ()
    """Blocks and those of their parameters that are as a step takes them if nothing is said."""
