"""The plan: the generated coroutine as data that can be printed and checked.

A body is a sequence of steps. Control leaves it by falling off its end, which means what the step
around it says, or by `Continue`, `Break` or `End`.
"""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.check.model import Checked
from plutoc.graph.model import Node
from plutoc_runtime.domain.status import Status

Place = str | None
"""The block at which an interrupted mission resumes; None: it begins."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Call:
    """A call of a block: `status = step(run, status, …)`."""

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
    """Whether it has no effect, so that no clone is sent."""


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
    """The body for some statuses of a `Switch`; `to` names its target."""

    statuses: tuple[Status, ...]
    body: Body
    to: str
    places: tuple[Place, ...] = ()
    """Instead of statuses, the places at which an interrupted mission resumes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Switch:
    """Branches by status, or by the place of interruption. The arms are disjoint."""

    arms: tuple[Arm, ...]
    decided: bool = False
    """Whether nothing else can arrive, so that the last arm needs no condition."""

    @property
    def enters(self) -> bool:
        """Whether it branches by the place of interruption."""
        return any(arm.places for arm in self.arms)


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrived:
    """An interrupted mission has reached the place where it resumes: from here on it is an ordinary one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Loop:
    """`while True`: falling off the end restarts it."""

    head: str
    body: Body


@dataclass(frozen=True, slots=True, kw_only=True)
class Continue:
    """Restart the innermost loop."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Break:
    """Leave the innermost loop."""


@dataclass(frozen=True, slots=True, kw_only=True)
class End:
    """The end of the mission or the branch: `return status`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Goto:
    """Inside a `Dispatch`: jump to the case of this name."""

    label: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One place of a `Dispatch`; its body ends with `Goto` or `End` on every way."""

    label: str
    body: Body


@dataclass(frozen=True, slots=True, kw_only=True)
class Dispatch:
    """For an unstructured graph: a state machine, with `match` in a loop."""

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
    """Parameters with their steps' default values, by block."""
