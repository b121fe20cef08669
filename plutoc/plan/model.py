"""The plan: what the generated coroutine does, as data that can be printed and checked.

A body is a sequence of steps. Control leaves it by falling off its end, which means what the step
around it says, or by `Continue`, `Break` or `End`.
"""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.check.model import Checked
from plutoc.graph.model import Node
from plutoc_runtime.status import Status


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Join:
    """A fork and the gate that closes it: `status = gate(run, status, branch, branch)`."""

    fork: Node
    gate: Node
    branches: tuple[Branch, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Arm:
    """What is done for some of the statuses of a `Switch`; `to` names where it leads."""

    statuses: tuple[Status, ...]
    body: Body
    to: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Switch:
    """Goes on by status. The arms share no status, and the last one takes all that is left."""

    arms: tuple[Arm, ...]


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


Step = Call | Join | Switch | Loop | Continue | Break | End | Goto | Dispatch
Body = tuple[Step, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """An app's flow."""

    checked: Checked
    body: Body
